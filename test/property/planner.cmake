set(planner_tests ${CMAKE_CURRENT_LIST_DIR}/planner)
otter_nav_test(property_planner
  SOURCES ${planner_tests}/planner_test.cpp ${planner_tests}/search_test.cpp
          ${planner_tests}/speed_limit_test.cpp
  ROOMS planner)
