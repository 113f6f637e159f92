otter_nav_test(loop_mission_benchmark LONG
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/benchmark/mission_benchmark_test.cpp ROOMS scenario)
target_compile_definitions(test_loop_mission_benchmark PRIVATE
  MISSION_BENCHMARK="$<TARGET_FILE:mission_benchmark>")
add_dependencies(test_loop_mission_benchmark mission_benchmark)
