set(optimizer_tests ${CMAKE_CURRENT_LIST_DIR}/optimizer)
otter_nav_test(property_optimizer
  SOURCES ${optimizer_tests}/all_round_test.cpp ${optimizer_tests}/global_optimizer_test.cpp
  ROOMS optimizer)
