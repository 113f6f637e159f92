otter_nav_test(unit_tracker_solver SOURCES ${CMAKE_CURRENT_LIST_DIR}/tracker/solver_test.cpp
               ROOMS tracker tracker_oracle)
otter_nav_test(unit_tracker_box_qp SOURCES ${CMAKE_CURRENT_LIST_DIR}/tracker/box_qp_test.cpp
               ROOMS tracker)
otter_nav_test(unit_tracker
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/tracker/bow_guard_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/handover_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/hull_room_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/navigator_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/options_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/orbital_motion_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/predictive_controller_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/reference_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/station_keeper_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/tracker_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/wave_frequency_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracker/wind_corridor_test.cpp
  ROOMS tracker)
otter_nav_test(unit_tracker_allocation
               SOURCES ${CMAKE_CURRENT_LIST_DIR}/tracker/allocation_test.cpp ROOMS tracker)
otter_nav_test(unit_tracker_csv_path
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/tracker/csv_path_test.cpp
    ${PROJECT_SOURCE_DIR}/benchmark/tracking/csv_path.cpp
  ROOMS base vessel)
otter_nav_test(unit_tracker_estimator SOURCES ${CMAKE_CURRENT_LIST_DIR}/tracker/estimator_test.cpp
               ROOMS tracker)
