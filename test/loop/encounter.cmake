otter_nav_test(loop_encounter LONG
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/encounter/encounters_test.cpp ROOMS simulation)
