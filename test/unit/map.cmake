set(map_tests ${CMAKE_CURRENT_LIST_DIR}/map)
otter_nav_test(unit_map
  SOURCES ${map_tests}/distance_field_test.cpp ${map_tests}/chart_test.cpp
          ${map_tests}/occupancy_map_test.cpp
  ROOMS map)
