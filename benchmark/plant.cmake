otter_nav_program(plant_benchmark SOURCES ${CMAKE_CURRENT_LIST_DIR}/plant_benchmark.cpp
  ROOMS plant map)
target_compile_definitions(plant_benchmark PRIVATE OTTER_NAV_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
