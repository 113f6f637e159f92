otter_nav_program(tracking_benchmark
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/tracking_benchmark.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracking/closed_loop.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracking/csv_path.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracking/paths.cpp
  ROOMS tracker plant config)
