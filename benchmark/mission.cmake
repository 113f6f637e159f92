otter_nav_program(mission_benchmark
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/mission_benchmark.cpp ROOMS simulation)
