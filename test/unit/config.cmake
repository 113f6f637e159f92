set(config_tests ${CMAKE_CURRENT_LIST_DIR}/config)
otter_nav_test(unit_config
  SOURCES ${config_tests}/fields_test.cpp ${config_tests}/shipped_test.cpp
  ROOMS config map planner tracker plant traffic identification mission)
