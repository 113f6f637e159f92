otter_nav_test(unit_map_distance_field SOURCES ${CMAKE_CURRENT_LIST_DIR}/map/distance_field_test.cpp ROOMS map)
