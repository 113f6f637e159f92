otter_nav_test(unit_map_distance_field SOURCES ${CMAKE_CURRENT_LIST_DIR}/map/distance_field_test.cpp ROOMS map)
otter_nav_test(unit_map_chart SOURCES ${CMAKE_CURRENT_LIST_DIR}/map/chart_test.cpp ROOMS map)
otter_nav_test(unit_map_occupancy_map SOURCES ${CMAKE_CURRENT_LIST_DIR}/map/occupancy_map_test.cpp ROOMS map)
