find_package(CLI11 REQUIRED)
# Recorded propeller speeds through a plant model: the program, and the tests against recordings.
otter_nav_room(plant_replay
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/replay/recording.cpp ${CMAKE_CURRENT_LIST_DIR}/replay/replay.cpp
  ROOMS plant)
target_include_directories(otter_nav_plant_replay PUBLIC ${CMAKE_CURRENT_LIST_DIR})
otter_nav_program(plant_replay SOURCES ${CMAKE_CURRENT_LIST_DIR}/plant_replay.cpp
  ROOMS plant_replay LIBRARIES CLI11::CLI11)
