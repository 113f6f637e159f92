find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
otter_nav_program(planner_benchmark
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/planner_benchmark.cpp
          ${CMAKE_CURRENT_LIST_DIR}/planner_cases.cpp
          ${CMAKE_CURRENT_LIST_DIR}/planner_dump.cpp
          ${CMAKE_CURRENT_LIST_DIR}/planner_report.cpp
          ${CMAKE_CURRENT_LIST_DIR}/shortest_way.cpp
  ROOMS planner scenario
  LIBRARIES CLI11::CLI11 nlohmann_json::nlohmann_json)
otter_nav_program(ompl_benchmark
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/ompl_benchmark.cpp
          ${CMAKE_CURRENT_LIST_DIR}/ompl_problem.cpp
          ${CMAKE_CURRENT_LIST_DIR}/ompl_recorder.cpp
          ${CMAKE_CURRENT_LIST_DIR}/shortest_way.cpp
  ROOMS planner planner_ompl scenario
  LIBRARIES CLI11::CLI11)
