set(stopping_tests ${CMAKE_CURRENT_LIST_DIR}/stopping)
otter_nav_test(unit_stopping
  SOURCES ${stopping_tests}/back_off_test.cpp ${stopping_tests}/braking_test.cpp
          ${stopping_tests}/escape_test.cpp ${stopping_tests}/splice_test.cpp
          ${stopping_tests}/stand_aside_test.cpp
  ROOMS stopping)
