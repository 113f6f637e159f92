// What is really there: the world's occupied cells with each cell's distance to the nearest one, so
// that beams and contact tests can jump over open water.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::plant {

class WorldMap {
 public:
  // Only occupied cells are walls; everything beyond the grid is open water.
  explicit WorldMap(const map::OccupancyGrid& grid);

  [[nodiscard]] const map::GridGeometry& geometry() const { return geometry_; }
  // Chebyshev distance in cells to the nearest occupied cell: 0 in one, saturating at 255. Every
  // cell nearer than that in both directions is free. 1 beyond the grid.
  [[nodiscard]] int freeCells(int column, int row) const {
    return geometry_.containsCell(column, row) ? distance_[geometry_.index(column, row)] : 1;
  }

  // Distance, m, from `from` along the unit vector `direction` to the first occupied cell's edge;
  // infinity if there is none within `range_m`. Exact cell by cell (Amanatides and Woo 1987), but
  // whole empty squares at a time.
  [[nodiscard]] double castRay(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                               double range_m) const;

 private:
  map::GridGeometry geometry_;
  std::vector<std::uint8_t> distance_;
};

}  // namespace otter_nav::plant
