// Walks a lidar's beams through a grid of columns and layers.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::map {

// Equal layers between two heights.
struct Layers {
  double bottom_m = 0.0;
  double thickness_m = 0.25;
  int count = 1;

  // The layer a height lies in, or -1.
  [[nodiscard]] int at(double z_m) const {
    const double layer = (z_m - bottom_m) / thickness_m;
    return layer >= 0.0 && layer < count ? static_cast<int>(layer) : -1;
  }
};

// Calls visit(cell index, layer) for each cell the ray crosses from `origin` along `direction`
// (unit) up to `length`, in order, while it is within the grid and for where it is within the
// layers, each cell at the height of the ray's middle in it (Amanatides and Woo 1987).
template <typename Visit>
void walkBeam(const GridGeometry& grid, const Layers& layers, const Eigen::Vector3d& origin,
              const Eigen::Vector3d& direction, double length, const Visit& visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d start = (origin.head<2>() - grid.origin) / grid.resolution_m;
  int cell[2];
  int step[2];
  double next[2];
  double stride[2];
  for (int axis = 0; axis < 2; ++axis) {
    cell[axis] = static_cast<int>(std::floor(start[axis]));
    const double d = direction[axis];
    step[axis] = d > 0.0 ? 1 : -1;
    const double to_side = d > 0.0 ? cell[axis] + 1 - start[axis] : start[axis] - cell[axis];
    stride[axis] = d != 0.0 ? grid.resolution_m / std::abs(d) : kNever;
    next[axis] = d != 0.0 ? to_side * stride[axis] : kNever;
  }
  double entered = 0.0;
  while (entered < length && grid.containsCell(cell[0], cell[1])) {
    const int axis = next[0] < next[1] ? 0 : 1;
    const double leaves = std::min(next[axis], length);
    const int layer = layers.at(origin.z() + 0.5 * (entered + leaves) * direction.z());
    if (layer >= 0) {
      visit(grid.index(cell[0], cell[1]), layer);
    }
    entered = next[axis];
    next[axis] += stride[axis];
    cell[axis] += step[axis];
  }
}

}  // namespace otter_nav::map
