find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(ompl REQUIRED)
otter_nav_program(planner_benchmark
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/planner_benchmark.cpp
          ${CMAKE_CURRENT_LIST_DIR}/planner_cases.cpp
          ${CMAKE_CURRENT_LIST_DIR}/planner_dump.cpp
          ${CMAKE_CURRENT_LIST_DIR}/planner_load.cpp
          ${CMAKE_CURRENT_LIST_DIR}/planner_report.cpp
          ${CMAKE_CURRENT_LIST_DIR}/shortest_way.cpp
  ROOMS planner scenario
  LIBRARIES CLI11::CLI11 nlohmann_json::nlohmann_json)
otter_nav_program(ompl_benchmark
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/ompl/ompl_benchmark.cpp
          ${CMAKE_CURRENT_LIST_DIR}/ompl/ompl_planner.cpp
          ${CMAKE_CURRENT_LIST_DIR}/ompl/ompl_problem.cpp
          ${CMAKE_CURRENT_LIST_DIR}/ompl/ompl_recorder.cpp
          ${CMAKE_CURRENT_LIST_DIR}/shortest_way.cpp
  ROOMS planner scenario
  LIBRARIES CLI11::CLI11 ${OMPL_LIBRARIES})
target_include_directories(ompl_benchmark SYSTEM PRIVATE ${OMPL_INCLUDE_DIRS})
