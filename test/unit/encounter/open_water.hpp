// Water without anything in it, and who is under way there, for the room's tests.
#pragma once

#include "otter_nav/base/planar.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/map/occupancy_grid.hpp"
#include "otter_nav/traffic/track.hpp"

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

// A square of 4 m, well known.
inline traffic::Track square(int id, const Eigen::Vector2d& position,
                             const Eigen::Vector2d& velocity) {
  traffic::Track track;
  track.id = id;
  track.position = position;
  track.velocity = velocity;
  track.heading_rad = angleOf(velocity);
  track.length_m = track.beam_m = 4.0;
  track.covariance.diagonal() << 0.02, 0.02, 0.02, 0.02;
  return track;
}

}  // namespace otter_nav::encounter::test
