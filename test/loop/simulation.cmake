otter_nav_test(loop_simulation LONG
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/simulation/closed_loop_test.cpp ROOMS simulation)
