set(vessel_tests ${CMAKE_CURRENT_LIST_DIR}/vessel)
otter_nav_test(unit_vessel
  SOURCES ${vessel_tests}/model_test.cpp ${vessel_tests}/inverse_dynamics_test.cpp
          ${vessel_tests}/parameters_test.cpp ${vessel_tests}/scripted_vessel_test.cpp
          ${vessel_tests}/steady_motion_test.cpp ${vessel_tests}/rest_test.cpp
  ROOMS vessel)
set(trajectory_tests ${CMAKE_CURRENT_LIST_DIR}/trajectory)
otter_nav_test(unit_trajectory
  SOURCES ${trajectory_tests}/trajectory_test.cpp ${trajectory_tests}/polynomial_test.cpp
  ROOMS trajectory)
set(base_tests ${CMAKE_CURRENT_LIST_DIR}/base)
otter_nav_test(unit_base
  SOURCES ${base_tests}/scan_test.cpp ${base_tests}/dual_test.cpp
  ROOMS base)
