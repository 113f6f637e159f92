// Walks a lidar's beams through a grid of columns and layers.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::map {

// Equal layers between two heights.
struct Layers {
  double bottom_m = 0.0;
  double thickness_m = 0.25;
  int count = 1;

  // The layer a height lies in, or -1.
  [[nodiscard]] int at(double z_m) const { return atLevel(level(z_m)); }
  // A height over the bottom in layers, and the layer that lies in.
  [[nodiscard]] double level(double z_m) const { return (z_m - bottom_m) / thickness_m; }
  [[nodiscard]] int atLevel(double level) const {
    return level >= 0.0 && level < count ? static_cast<int>(level) : -1;
  }
};

// Calls visit(cell index, layer) for each cell the ray crosses from `origin` along `direction`
// (unit) up to `length`, in order, while it is within the grid and for where it is within the
// layers, each cell at the height of the ray's middle in it (Amanatides and Woo 1987). Which side a
// ray leaves a cell by is anybody's guess, so nothing branches on it.
template <typename Visit>
void walkBeam(const GridGeometry& grid, const Layers& layers, const Eigen::Vector3d& origin,
              const Eigen::Vector3d& direction, double length, const Visit& visit) {
  constexpr double kNever = 1e30;  // finite, for it is multiplied by 0
  struct Axis {
    Axis(double start, double d, double resolution_m)
        : cell(static_cast<int>(std::floor(start))),
          step(d > 0.0 ? 1 : -1),
          stride(d != 0.0 ? resolution_m / std::abs(d) : kNever),
          next(d != 0.0 ? stride * (d > 0.0 ? cell + 1 - start : start - cell) : kNever) {}
    void advance(bool crossed) {
      cell += static_cast<int>(crossed) * step;
      next += static_cast<double>(crossed) * stride;
    }
    int cell, step;
    double stride, next;  // along the ray, m
  };
  const Eigen::Vector2d start = (origin.head<2>() - grid.origin) / grid.resolution_m;
  Axis x(start.x(), direction.x(), grid.resolution_m);
  Axis y(start.y(), direction.y(), grid.resolution_m);
  const double level = layers.level(origin.z());
  const double half_rise = 0.5 * direction.z() / layers.thickness_m;  // in a metre of the ray
  double entered = 0.0;
  while (entered < length && grid.containsCell(x.cell, y.cell)) {
    const double leaves = std::min(x.next, y.next);
    const int layer = layers.atLevel(level + half_rise * (entered + std::min(leaves, length)));
    if (layer >= 0) {
      visit(grid.index(x.cell, y.cell), layer);
    }
    entered = leaves;
    const bool through_x = x.next < y.next;
    x.advance(through_x);
    y.advance(!through_x);
  }
}

}  // namespace otter_nav::map
