foreach(name early_end hull_search obvp open_water options plans_in_load preferred_room tree work)
  otter_nav_test(unit_planner_${name}
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/planner/${name}_test.cpp ROOMS planner)
endforeach()
