otter_nav_test(loop_mission_weather
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/mission/gust_reach_test.cpp ROOMS mission tracker plant)
