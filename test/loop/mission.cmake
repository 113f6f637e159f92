otter_nav_test(loop_mission
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/mission/closed_loop_test.cpp ROOMS mission_loop)
