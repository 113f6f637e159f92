otter_nav_program(topology_benchmark SOURCES ${CMAKE_CURRENT_LIST_DIR}/topology_benchmark.cpp ROOMS topology)
target_compile_definitions(topology_benchmark PRIVATE OTTER_NAV_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
