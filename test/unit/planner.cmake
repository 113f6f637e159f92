otter_nav_test(unit_planner_obvp SOURCES ${CMAKE_CURRENT_LIST_DIR}/planner/obvp_test.cpp ROOMS planner)
otter_nav_test(unit_planner_tree SOURCES ${CMAKE_CURRENT_LIST_DIR}/planner/tree_test.cpp ROOMS planner)
