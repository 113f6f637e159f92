// Water without anything in it, for the room's tests.
#pragma once

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::encounter::test {

inline map::DistanceField openWater() {
  map::OccupancyGrid grid;
  grid.geometry.width = 250;
  grid.geometry.height = 250;
  grid.geometry.resolution_m = 2.0;
  grid.geometry.origin = {-250.0, -250.0};
  grid.cells.assign(250U * 250U, map::Cell::kFree);
  map::DistanceFieldOptions options;
  options.max_distance_m = 12.0;
  return map::DistanceField(grid, options);
}

}  // namespace otter_nav::encounter::test
