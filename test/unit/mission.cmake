set(mission_tests ${CMAKE_CURRENT_LIST_DIR}/mission)
otter_nav_test(unit_mission_safety
  SOURCES ${mission_tests}/safety_test.cpp ${mission_tests}/weather_test.cpp
          ${mission_tests}/plan_requests_test.cpp ${mission_tests}/near_obstacles_test.cpp
  ROOMS mission)
otter_nav_test(unit_mission_supervisor
  SOURCES ${mission_tests}/supervisor_test.cpp ${mission_tests}/supervisor_goal_test.cpp
          ${mission_tests}/supervisor_wind_test.cpp ${mission_tests}/supervisor_back_off_test.cpp
          ${mission_tests}/supervisor_edge_test.cpp ${mission_tests}/supervisor_suspend_test.cpp
          ${mission_tests}/supervisor_speed_test.cpp ${mission_tests}/supervisor_behind_test.cpp
  ROOMS mission)
