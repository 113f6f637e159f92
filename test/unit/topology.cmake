otter_nav_test(unit_topology_dubins SOURCES ${CMAKE_CURRENT_LIST_DIR}/topology/dubins_test.cpp ROOMS topology)
otter_nav_test(unit_topology_guide_path SOURCES ${CMAKE_CURRENT_LIST_DIR}/topology/guide_path_test.cpp ROOMS topology)
otter_nav_test(unit_topology_allocation SOURCES ${CMAKE_CURRENT_LIST_DIR}/topology/allocation_test.cpp ROOMS topology)
