find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
otter_nav_program(tracking_traffic
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/tracking_traffic.cpp ROOMS traffic
  LIBRARIES nlohmann_json::nlohmann_json)
