# What `identify` leaves behind: tables, series and plots.
otter_nav_room(identification_report
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/identify/plots.cpp ${CMAKE_CURRENT_LIST_DIR}/identify/report.cpp
  ROOMS identification)
target_include_directories(otter_nav_identification_report PUBLIC ${CMAKE_CURRENT_LIST_DIR})
# Bags are read where there is ROS; the rest of the program is the same.
if(OTTER_NAV_CORE_ONLY)
  otter_nav_program(identify
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/identify.cpp ${CMAKE_CURRENT_LIST_DIR}/identify/bag_reader_without_ros.cpp
    ROOMS identification_report)
else()
  otter_nav_program(identify
    SOURCES ${CMAKE_CURRENT_LIST_DIR}/identify.cpp ${CMAKE_CURRENT_LIST_DIR}/identify/bag_reader.cpp
    ROOMS identification_report ros)
endif()
otter_nav_program(excitation_run
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/excitation_run.cpp ROOMS identification plant)
