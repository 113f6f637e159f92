set(traffic_tests ${CMAKE_CURRENT_LIST_DIR}/traffic)
otter_nav_test(unit_traffic
  SOURCES ${traffic_tests}/association_test.cpp ${traffic_tests}/motion_filter_test.cpp
          ${traffic_tests}/scan_clusters_test.cpp ${traffic_tests}/track_layer_test.cpp
          ${traffic_tests}/tracked_vessel_test.cpp
  ROOMS traffic)
otter_nav_test(unit_traffic_tracker LONG TIMEOUT 600 SOURCES ${traffic_tests}/tracker_test.cpp ROOMS traffic plant)
