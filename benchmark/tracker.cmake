# The tracker's problem solved by Ipopt, apart: what benchmark and tests compare the tracker with.
find_package(PkgConfig REQUIRED)
pkg_check_modules(IPOPT REQUIRED IMPORTED_TARGET ipopt)
otter_nav_room(tracker_oracle
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/tracking/oracle/ipopt_solver.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracking/oracle/shooting_problem.cpp
  ROOMS tracker
  LIBRARIES PkgConfig::IPOPT)
target_include_directories(otter_nav_tracker_oracle PUBLIC ${CMAKE_CURRENT_LIST_DIR})
# The paths that trackers are compared on.
otter_nav_room(tracking_paths
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/tracking/csv_path.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracking/paths.cpp
  ROOMS base vessel)
otter_nav_program(tracking_benchmark
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/tracking_benchmark.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracking/closed_loop.cpp
  ROOMS tracking_paths tracker plant config)
otter_nav_program(nmpc_benchmark
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/nmpc_benchmark.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracking/nmpc_cases.cpp
  ROOMS tracker tracker_oracle config)
otter_nav_program(tracking_limit
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/tracking_limit.cpp
    ${CMAKE_CURRENT_LIST_DIR}/tracking/foresight.cpp
  ROOMS tracking_paths tracker plant config)
