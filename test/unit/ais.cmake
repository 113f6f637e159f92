find_package(nlohmann_json REQUIRED)
# gpsd's decoder is the oracle where it is installed.
find_program(OTTER_NAV_GPSDECODE gpsdecode)
otter_nav_test(unit_ais_message SOURCES ${CMAKE_CURRENT_LIST_DIR}/ais/message_test.cpp ROOMS ais
               LIBRARIES nlohmann_json::nlohmann_json)
target_compile_definitions(test_unit_ais_message PRIVATE
  GPSDECODE="$<$<BOOL:${OTTER_NAV_GPSDECODE}>:${OTTER_NAV_GPSDECODE}>")
