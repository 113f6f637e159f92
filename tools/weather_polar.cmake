otter_nav_room(weather_polar SOURCES ${CMAKE_CURRENT_LIST_DIR}/weather_polar/polar.cpp ROOMS vessel config)
target_include_directories(otter_nav_weather_polar PUBLIC ${CMAKE_CURRENT_LIST_DIR})
otter_nav_program(weather_polar SOURCES ${CMAKE_CURRENT_LIST_DIR}/weather_polar.cpp ROOMS weather_polar)
