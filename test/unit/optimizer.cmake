otter_nav_test(unit_optimizer_spline SOURCES ${CMAKE_CURRENT_LIST_DIR}/optimizer/spline_problem_test.cpp ROOMS optimizer)
otter_nav_test(unit_optimizer_spin SOURCES ${CMAKE_CURRENT_LIST_DIR}/optimizer/spin_test.cpp ROOMS optimizer)
otter_nav_test(unit_optimizer_local SOURCES ${CMAKE_CURRENT_LIST_DIR}/optimizer/local_optimizer_test.cpp ROOMS optimizer)
otter_nav_test(unit_optimizer_end_manoeuvre SOURCES ${CMAKE_CURRENT_LIST_DIR}/optimizer/end_manoeuvre_test.cpp ROOMS optimizer)
