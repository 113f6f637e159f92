set(traffic_tests ${CMAKE_CURRENT_LIST_DIR}/traffic)
otter_nav_test(unit_traffic_track_layer SOURCES ${traffic_tests}/track_layer_test.cpp ROOMS traffic)
otter_nav_test(unit_traffic_motion_filter SOURCES ${traffic_tests}/motion_filter_test.cpp ROOMS traffic)
otter_nav_test(unit_traffic_tracker SOURCES ${traffic_tests}/tracker_test.cpp ROOMS traffic plant)
