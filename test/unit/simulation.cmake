otter_nav_test(unit_simulation_monitor
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/simulation/monitor_test.cpp ROOMS simulation)
