otter_nav_program(optimizer_benchmark SOURCES ${CMAKE_CURRENT_LIST_DIR}/optimizer_benchmark.cpp
                  ROOMS optimizer topology map config scenario)
