// Waters between walls, where long ways lead through narrow places and round sharp corners: streets
// of a flooded town, halls with a door in each wall, a harbour's piers.
#pragma once

#include "otter_nav/base/random.hpp"
#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::scenario {

enum class Walls {
  kNone,
  kStreets,  // blocks 18 to 45 m apart with 5 to 10 m between, one street in five walled off
  kHalls,    // rooms of 12 to 40 m, a door of 4 to 7 m in each wall, and pillars
  kHarbour   // piers with fingers 9 to 13 m apart, two moles with an entrance of 10 m each, buoys
};

// Draws them, and a border all round, on a grid centred on the map's origin.
void drawWalls(Walls walls, Random& random, map::OccupancyGrid& grid);

}  // namespace otter_nav::scenario
