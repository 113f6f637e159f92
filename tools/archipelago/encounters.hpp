// Encounters in open water. Imazu's and the captains': everybody meets at the map's origin after
// 100 s if we sail our speed from the first second on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "otter_nav/map/occupancy_grid.hpp"
#include "otter_nav/scenario/scenario.hpp"

namespace otter_nav::scenario {

struct Encounter {
  std::string kind;  // part of a set; may be empty
  Mission mission;
  std::vector<vessel::ScriptedVessel> vessels;
};

// Imazu's 22 cases (1987), by the headings in Sawada, Sato and Majima (2021).
[[nodiscard]] std::vector<Encounter> imazuCases();

// Eight who never give way: four from port, slow and fast, at 60, 90, 120 and 45 degrees to our
// course; two that overtake; one head-on who turns to port; one from port who turns after us.
[[nodiscard]] std::vector<Encounter> stubbornCaptains();

// Waters of 80 m by 80 m to cross at up to 4 m/s from one side to the opposite one, among squares
// of 4 m that go round for ever on loops: circles, polygons, to and fro. `each` of every kind:
// easy, 5 at 1 to 2 m/s; medium, 12 at up to 3 m/s; hard, 24 at up to 4 m/s. In the first seconds
// none is near where we start; later they go where their loops lead, over start and goal too.
[[nodiscard]] std::vector<Encounter> movingFields(std::uint64_t seed, int each);

// A square around the origin, free all over.
[[nodiscard]] map::OccupancyGrid openWater(double side_m);

}  // namespace otter_nav::scenario
