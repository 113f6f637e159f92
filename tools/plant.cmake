find_package(CLI11 REQUIRED)
otter_nav_program(plant_replay SOURCES ${CMAKE_CURRENT_LIST_DIR}/plant_replay.cpp
  ROOMS plant LIBRARIES CLI11::CLI11)
