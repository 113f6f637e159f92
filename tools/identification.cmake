# Bags are read where there is ROS; the rest of the program is the same.
if(OTTER_NAV_CORE_ONLY)
  otter_nav_program(identify
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/identify.cpp ${CMAKE_CURRENT_LIST_DIR}/bag_reader_without_ros.cpp
    ROOMS identification)
else()
  otter_nav_program(identify
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/identify.cpp
    ROOMS identification bag)
endif()
otter_nav_program(excitation_run
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/excitation_run.cpp ROOMS identification plant)
