set(optimizer_tests ${CMAKE_CURRENT_LIST_DIR}/optimizer)
otter_nav_test(unit_optimizer
  SOURCES ${optimizer_tests}/end_manoeuvre_test.cpp ${optimizer_tests}/local_optimizer_test.cpp
          ${optimizer_tests}/spin_test.cpp ${optimizer_tests}/spline_problem_test.cpp
          ${optimizer_tests}/stop_and_spin_test.cpp
  ROOMS optimizer)
