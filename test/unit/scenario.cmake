set(scenario_tests ${CMAKE_CURRENT_LIST_DIR}/scenario)
otter_nav_test(unit_scenario_files SOURCES ${scenario_tests}/scenario_test.cpp ROOMS scenario)
otter_nav_test(unit_scenario_archipelago SOURCES ${scenario_tests}/archipelago_test.cpp ROOMS archipelago)
otter_nav_test(unit_scenario_report SOURCES ${scenario_tests}/report_test.cpp ROOMS scenario)
