// Small maps for the planner's tests: 80 m by 80 m around the origin, 0.25 m a cell.
#pragma once

#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::planner::test {

inline map::OccupancyGrid openGrid() {
  map::OccupancyGrid grid;
  grid.geometry.width = 320;
  grid.geometry.height = 320;
  grid.geometry.resolution_m = 0.25;
  grid.geometry.origin = {-40.0, -40.0};
  grid.cells.assign(320U * 320U, map::Cell::kFree);
  return grid;
}

// Occupies the rectangle from its south-west corner.
inline void fill(map::OccupancyGrid& grid, double x, double y, double width, double height) {
  for (int row = 0; row < grid.geometry.height; ++row) {
    for (int column = 0; column < grid.geometry.width; ++column) {
      const Eigen::Vector2d p = grid.geometry.centreOf(column, row);
      if (p.x() > x && p.x() < x + width && p.y() > y && p.y() < y + height) {
        grid.cells[grid.geometry.index(column, row)] = map::Cell::kOccupied;
      }
    }
  }
}

inline map::DistanceField openWater() {
  return map::DistanceField(openGrid(), map::DistanceFieldOptions{});
}

inline map::DistanceField withObstacle(double x, double y, double width, double height) {
  map::OccupancyGrid grid = openGrid();
  fill(grid, x, y, width, height);
  return map::DistanceField(grid, map::DistanceFieldOptions{});
}

}  // namespace otter_nav::planner::test
