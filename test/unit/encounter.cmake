set(encounter_tests ${CMAKE_CURRENT_LIST_DIR}/encounter)
otter_nav_test(unit_encounter
  SOURCES ${encounter_tests}/rules_test.cpp ${encounter_tests}/prospect_test.cpp
          ${encounter_tests}/manoeuvre_test.cpp ${encounter_tests}/pilot_test.cpp
          ${encounter_tests}/evasion_test.cpp ${encounter_tests}/met_motion_test.cpp
          ${encounter_tests}/lying_off_test.cpp ${encounter_tests}/swing_test.cpp
          ${encounter_tests}/surprise_test.cpp
  ROOMS encounter)
