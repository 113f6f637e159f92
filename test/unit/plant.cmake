otter_nav_test(unit_plant_models
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/plant/otter_model_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/plant/gazebo_otter_model_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/plant/models_test.cpp
  ROOMS plant)
otter_nav_test(unit_plant
  SOURCES
    ${CMAKE_CURRENT_LIST_DIR}/plant/options_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/plant/replay_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/plant/simulator_test.cpp
    ${CMAKE_CURRENT_LIST_DIR}/plant/waves_test.cpp
  ROOMS plant_replay)
otter_nav_test(unit_plant_other_vessels SOURCES ${CMAKE_CURRENT_LIST_DIR}/plant/other_vessels_test.cpp ROOMS plant)
