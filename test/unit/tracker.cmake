set(tracker_tests ${CMAKE_CURRENT_LIST_DIR}/tracker)
otter_nav_test(unit_tracker LONG TIMEOUT 600
  SOURCES ${tracker_tests}/bow_guard_test.cpp ${tracker_tests}/box_qp_test.cpp
          ${tracker_tests}/csv_path_test.cpp ${tracker_tests}/estimator_test.cpp
          ${tracker_tests}/handover_test.cpp ${tracker_tests}/hull_room_test.cpp
          ${tracker_tests}/navigator_test.cpp ${tracker_tests}/options_test.cpp
          ${tracker_tests}/orbital_motion_test.cpp ${tracker_tests}/predictive_controller_test.cpp
          ${tracker_tests}/reference_test.cpp ${tracker_tests}/solver_test.cpp
          ${tracker_tests}/station_keeper_test.cpp ${tracker_tests}/tracker_test.cpp
          ${tracker_tests}/wave_frequency_test.cpp ${tracker_tests}/wind_corridor_test.cpp
  ROOMS tracker tracker_oracle tracking_paths)
# By itself, since it replaces operator new.
otter_nav_test(unit_tracker_allocation SOURCES ${tracker_tests}/allocation_test.cpp ROOMS tracker)
