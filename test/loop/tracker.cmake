otter_nav_test(loop_tracker LONG
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/tracker/carried_turn_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/evasion_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/gusts_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/handover_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/odometry_faults_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/short_leg_test.cpp
  ROOMS tracker plant planner encounter)
