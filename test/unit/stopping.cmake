set(stopping_tests ${CMAKE_CURRENT_LIST_DIR}/stopping)
otter_nav_test(unit_stopping_braking SOURCES ${stopping_tests}/braking_test.cpp ROOMS stopping)
otter_nav_test(unit_stopping_back_off SOURCES ${stopping_tests}/back_off_test.cpp ROOMS stopping)
otter_nav_test(unit_stopping_stand_aside SOURCES ${stopping_tests}/stand_aside_test.cpp ROOMS stopping)
