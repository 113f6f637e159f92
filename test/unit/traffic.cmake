set(traffic_tests ${CMAKE_CURRENT_LIST_DIR}/traffic)
otter_nav_test(unit_traffic_track_layer SOURCES ${traffic_tests}/track_layer_test.cpp ROOMS traffic)
