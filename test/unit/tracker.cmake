otter_nav_test(unit_tracker_solver SOURCES ${CMAKE_CURRENT_LIST_DIR}/tracker/solver_test.cpp
               ROOMS tracker tracker_oracle)
otter_nav_test(unit_tracker SOURCES ${CMAKE_CURRENT_LIST_DIR}/tracker/tracker_test.cpp ROOMS tracker)
