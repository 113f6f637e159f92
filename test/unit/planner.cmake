set(planner_tests ${CMAKE_CURRENT_LIST_DIR}/planner)
otter_nav_test(unit_planner TIMEOUT 600
  SOURCES ${planner_tests}/early_end_test.cpp ${planner_tests}/hull_search_test.cpp
          ${planner_tests}/obvp_test.cpp ${planner_tests}/open_water_test.cpp
          ${planner_tests}/options_test.cpp ${planner_tests}/plans_in_load_test.cpp
          ${planner_tests}/preferred_room_test.cpp ${planner_tests}/tree_test.cpp
          ${planner_tests}/work_test.cpp
  ROOMS planner)
