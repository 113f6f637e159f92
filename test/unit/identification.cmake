foreach(test csv data_set identifiability manoeuvres recovery report sensitivity)
  otter_nav_test(unit_identification_${test}
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/identification/${test}_test.cpp ROOMS identification)
endforeach()
