set(feasibility_tests ${CMAKE_CURRENT_LIST_DIR}/feasibility)
otter_nav_test(unit_feasibility
  SOURCES ${feasibility_tests}/edge_check_test.cpp ${feasibility_tests}/verifier_test.cpp
          ${feasibility_tests}/moving_obstacle_test.cpp ${feasibility_tests}/lee_shore_test.cpp
  ROOMS feasibility optimizer planner)
