otter_nav_test(loop_simulation
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/simulation/closed_loop_test.cpp ROOMS simulation)
