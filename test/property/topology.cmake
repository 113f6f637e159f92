find_package(ompl REQUIRED)
otter_nav_test(property_topology_dubins SOURCES ${CMAKE_CURRENT_LIST_DIR}/topology/dubins_test.cpp
               ROOMS topology LIBRARIES ${OMPL_LIBRARIES})
target_include_directories(test_property_topology_dubins SYSTEM PRIVATE ${OMPL_INCLUDE_DIRS})
otter_nav_test(property_topology_guide_path SOURCES ${CMAKE_CURRENT_LIST_DIR}/topology/guide_path_test.cpp ROOMS topology)
