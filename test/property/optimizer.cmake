otter_nav_test(property_optimizer SOURCES ${CMAKE_CURRENT_LIST_DIR}/optimizer/global_optimizer_test.cpp ROOMS optimizer)
otter_nav_test(property_optimizer_all_round
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/optimizer/all_round_test.cpp ROOMS optimizer)
