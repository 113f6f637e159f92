set(topology_tests ${CMAKE_CURRENT_LIST_DIR}/topology)
otter_nav_test(unit_topology
  SOURCES ${topology_tests}/dubins_test.cpp ${topology_tests}/guide_path_test.cpp
  ROOMS topology)
# On its own: it replaces operator new to count.
otter_nav_test(unit_topology_allocation SOURCES ${topology_tests}/allocation_test.cpp ROOMS topology)
