# Seeded archipelagos (drawing, missions, other vessels' routes), waters between walls, narrow
# fields of cylinders, and encounters in open water.
otter_nav_room(archipelago
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/archipelago/archipelago.cpp
    ${CMAKE_CURRENT_LIST_DIR}/archipelago/cylinder_field.cpp
    ${CMAKE_CURRENT_LIST_DIR}/archipelago/encounters.cpp
    ${CMAKE_CURRENT_LIST_DIR}/archipelago/missions.cpp
    ${CMAKE_CURRENT_LIST_DIR}/archipelago/routes.cpp
    ${CMAKE_CURRENT_LIST_DIR}/archipelago/walls.cpp
  ROOMS scenario)
target_include_directories(otter_nav_archipelago PUBLIC ${CMAKE_CURRENT_LIST_DIR})
otter_nav_program(scenario_generator
  SOURCES ${CMAKE_CURRENT_LIST_DIR}/archipelago/scenario_generator.cpp ROOMS archipelago)
