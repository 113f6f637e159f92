otter_nav_test(unit_optimizer_spline SOURCES ${CMAKE_CURRENT_LIST_DIR}/optimizer/spline_problem_test.cpp ROOMS optimizer)
