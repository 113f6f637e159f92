// Seeded archipelagos to sail and to test in: a chart (islands, breakwaters, pontoons, buoys), a
// world (the chart and what floats there uncharted), missions that can be sailed, and other
// vessels.
#pragma once

#include <cstdint>
#include <vector>

#include "archipelago/walls.hpp"
#include "otter_nav/base/random.hpp"
#include "otter_nav/base/result.hpp"
#include "otter_nav/map/occupancy_grid.hpp"
#include "otter_nav/scenario/scenario.hpp"

namespace otter_nav::scenario {

struct ArchipelagoOptions {
  double size_m = 300.0;       // of the square
  double resolution_m = 0.25;  // of a cell
  Walls walls = Walls::kNone;  // others: these instead of all that the counts say
  double islands = 18.0;       // per 300 m by 300 m, as all the counts here
  double breakwaters = 8.0;    // walls 1 m wide
  double charted = 110.0;      // buoys and pontoons in the chart
  double uncharted = 60.0;     // only in the world
  int local_missions = 10;     // `local_distance_m` apart, within 10 %
  double local_distance_m = 60.0;
  int cross_missions = 4;            // 0.63 to 1.1 of the size apart
  double clear_m = 4.0;              // start and goal keep this in the world
  double passage_clearance_m = 1.6;  // start and goal are connected at this in the world
  int vessels = 0;                   // others, on bent routes
  double route_clear_m = 8.0;   // their outlines keep this in the world, and of each start and goal
  double route_time_s = 600.0;  // they are under way for so long
};

// Refuses what can't be drawn: sizes and counts outside their ranges.
[[nodiscard]] Status check(const ArchipelagoOptions& options);

struct Archipelago {
  map::OccupancyGrid chart;
  map::OccupancyGrid world;
  std::vector<Mission> missions;
  std::vector<vessel::ScriptedVessel> vessels;
};

// The same for the same seed on every machine. An error if the options are out of range or no
// missions with the wanted properties are found (too dense, too small).
[[nodiscard]] Result<Archipelago> generateArchipelago(const ArchipelagoOptions& options,
                                                      std::uint64_t seed);

// What it is made of: draws islands, breakwaters and charted things, or walls, centred on the map's
// origin.
[[nodiscard]] map::OccupancyGrid drawChart(const ArchipelagoOptions& options, Random& random);
// Adds what floats about uncharted.
void drawUncharted(const ArchipelagoOptions& options, Random& random, map::OccupancyGrid& world);
// Missions on the world: clear by `clear_m` at both ends, connected at the passage's clearance
// (flood fill), never on a free straight line.
[[nodiscard]] Result<std::vector<Mission>> chooseMissions(const map::OccupancyGrid& world,
                                                          const ArchipelagoOptions& options,
                                                          Random& random);
// Vessels of 4 to 10 m at 0.6 to 2.4 m/s whose routes keep clear of the world and of the missions'
// ends.
[[nodiscard]] Result<std::vector<vessel::ScriptedVessel>> chooseRoutes(
    const map::OccupancyGrid& world, const std::vector<Mission>& missions,
    const ArchipelagoOptions& options, Random& random);

}  // namespace otter_nav::scenario
