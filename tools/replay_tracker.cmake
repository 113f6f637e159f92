# A recorded run through the tracker. Bags are read where there is ROS.
if(NOT OTTER_NAV_CORE_ONLY)
  find_package(CLI11 REQUIRED)
  find_package(nlohmann_json REQUIRED)
  set(folder ${CMAKE_CURRENT_LIST_DIR}/replay_tracker)
  otter_nav_program(replay_tracker
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/replay_tracker.cpp ${folder}/bag_file.cpp ${folder}/read_run.cpp
      ${folder}/retrack.cpp ${folder}/simulated_hull.cpp
    ROOMS ros tracker plant config LIBRARIES CLI11::CLI11 nlohmann_json::nlohmann_json)
  target_include_directories(replay_tracker PRIVATE ${CMAKE_CURRENT_LIST_DIR})
endif()
