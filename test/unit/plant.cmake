set(plant_tests ${CMAKE_CURRENT_LIST_DIR}/plant)
otter_nav_test(unit_plant
  SOURCES ${plant_tests}/gazebo_otter_model_test.cpp ${plant_tests}/models_test.cpp
          ${plant_tests}/options_test.cpp ${plant_tests}/other_vessels_test.cpp
          ${plant_tests}/otter_model_test.cpp ${plant_tests}/replay_test.cpp
          ${plant_tests}/simulator_test.cpp ${plant_tests}/waves_test.cpp
  ROOMS plant_replay plant)
