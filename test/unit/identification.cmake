set(identification_tests ${CMAKE_CURRENT_LIST_DIR}/identification)
otter_nav_test(unit_identification
  SOURCES ${identification_tests}/csv_test.cpp ${identification_tests}/data_set_test.cpp
          ${identification_tests}/identifiability_test.cpp ${identification_tests}/manoeuvres_test.cpp
          ${identification_tests}/recovery_test.cpp ${identification_tests}/sensitivity_test.cpp
          ${identification_tests}/report_test.cpp
  ROOMS identification identification_report)
