otter_nav_test(unit_weather_polar SOURCES ${CMAKE_CURRENT_LIST_DIR}/tools/weather_polar_test.cpp ROOMS weather_polar)
