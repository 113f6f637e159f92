otter_nav_test(loop_identification_otter LONG
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/identification/otter_test.cpp ROOMS identification_report plant)
