otter_nav_test(property_optimizer SOURCES ${CMAKE_CURRENT_LIST_DIR}/optimizer/global_optimizer_test.cpp ROOMS optimizer)
