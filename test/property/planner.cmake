foreach(name planner search speed_limit)
  otter_nav_test(property_planner_${name}
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/planner/${name}_test.cpp ROOMS planner)
endforeach()
