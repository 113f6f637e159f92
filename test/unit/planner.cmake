foreach(name obvp options tree)
  otter_nav_test(unit_planner_${name}
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/planner/${name}_test.cpp ROOMS planner)
endforeach()
