otter_nav_program(scenario_generator
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/scenario_generator.cpp ROOMS scenario)
