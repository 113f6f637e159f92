otter_nav_test(unit_vessel_model SOURCES ${CMAKE_CURRENT_LIST_DIR}/vessel/model_test.cpp ROOMS vessel)
otter_nav_test(unit_vessel_inverse_dynamics
               SOURCES ${CMAKE_CURRENT_LIST_DIR}/vessel/inverse_dynamics_test.cpp ROOMS vessel)
otter_nav_test(unit_vessel_parameters SOURCES ${CMAKE_CURRENT_LIST_DIR}/vessel/parameters_test.cpp ROOMS vessel)
otter_nav_test(unit_trajectory SOURCES ${CMAKE_CURRENT_LIST_DIR}/trajectory/trajectory_test.cpp ROOMS trajectory)
otter_nav_test(unit_polynomial SOURCES ${CMAKE_CURRENT_LIST_DIR}/trajectory/polynomial_test.cpp ROOMS trajectory)
otter_nav_test(unit_scan SOURCES ${CMAKE_CURRENT_LIST_DIR}/base/scan_test.cpp ROOMS base)
otter_nav_test(unit_dual SOURCES ${CMAKE_CURRENT_LIST_DIR}/base/dual_test.cpp ROOMS base)
otter_nav_test(unit_vessel_scripted SOURCES ${CMAKE_CURRENT_LIST_DIR}/vessel/scripted_vessel_test.cpp ROOMS vessel)
otter_nav_test(unit_vessel_steady_motion
               SOURCES ${CMAKE_CURRENT_LIST_DIR}/vessel/steady_motion_test.cpp ROOMS vessel)
otter_nav_test(unit_vessel_rest SOURCES ${CMAKE_CURRENT_LIST_DIR}/vessel/rest_test.cpp ROOMS vessel)
