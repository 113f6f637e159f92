otter_nav_test(property_plant
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/plant/disturbance_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/plant/energy_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/plant/lidar_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/plant/reference_test.cpp
  ROOMS plant_replay)
