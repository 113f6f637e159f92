foreach(test csv data_set identifiability manoeuvres recovery sensitivity)
  otter_nav_test(unit_identification_${test}
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/identification/${test}_test.cpp ROOMS identification)
endforeach()
otter_nav_test(unit_identification_report
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/identification/report_test.cpp ROOMS identification_report)
