otter_nav_test(unit_feasibility_edge_check
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/feasibility/edge_check_test.cpp ROOMS planner)
otter_nav_test(unit_feasibility_verifier
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/feasibility/verifier_test.cpp ROOMS optimizer)
otter_nav_test(unit_feasibility_moving_obstacle
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/feasibility/moving_obstacle_test.cpp ROOMS feasibility)
otter_nav_test(unit_feasibility_lee_shore
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/feasibility/lee_shore_test.cpp ROOMS feasibility)
