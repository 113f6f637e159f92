find_package(ompl REQUIRED)
set(topology_tests ${CMAKE_CURRENT_LIST_DIR}/topology)
otter_nav_test(property_topology
  SOURCES ${topology_tests}/dubins_test.cpp ${topology_tests}/guide_path_test.cpp
  ROOMS topology LIBRARIES ${OMPL_LIBRARIES})
target_include_directories(test_property_topology SYSTEM PRIVATE ${OMPL_INCLUDE_DIRS})
