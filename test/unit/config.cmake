otter_nav_test(unit_config_fields SOURCES ${CMAKE_CURRENT_LIST_DIR}/config/fields_test.cpp ROOMS config)
otter_nav_test(unit_config_shipped SOURCES ${CMAKE_CURRENT_LIST_DIR}/config/shipped_test.cpp
  ROOMS config map planner tracker plant traffic identification mission)
