set(scenario_tests ${CMAKE_CURRENT_LIST_DIR}/scenario)
otter_nav_test(unit_scenario
  SOURCES ${scenario_tests}/archipelago_test.cpp ${scenario_tests}/cylinder_field_test.cpp
          ${scenario_tests}/encounters_test.cpp ${scenario_tests}/report_test.cpp
          ${scenario_tests}/scenario_test.cpp
  ROOMS scenario archipelago)
