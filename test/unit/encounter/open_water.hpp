// Water without anything in it, for the room's tests.
#pragma once

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::encounter::test {

inline map::OccupancyGrid openGrid() {
  map::OccupancyGrid grid;
  grid.geometry.width = 250;
  grid.geometry.height = 250;
  grid.geometry.resolution_m = 2.0;
  grid.geometry.origin = {-250.0, -250.0};
  grid.cells.assign(250U * 250U, map::Cell::kFree);
  return grid;
}
inline map::DistanceField fieldOf(const map::OccupancyGrid& grid) {
  map::DistanceFieldOptions options;
  options.max_distance_m = 12.0;
  return map::DistanceField(grid, options);
}
inline map::DistanceField openWater() {
  return fieldOf(openGrid());
}
// From south to north, 8 m wide.
inline map::DistanceField channel() {
  map::OccupancyGrid grid = openGrid();
  for (std::size_t k = 0; k < grid.cells.size(); ++k) {
    const std::size_t column = k % 250U;
    grid.cells[k] = column < 123U || column > 126U ? map::Cell::kOccupied : map::Cell::kFree;
  }
  return fieldOf(grid);
}

}  // namespace otter_nav::encounter::test
