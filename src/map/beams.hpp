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
// layers, each cell at the height of the ray's middle in it (Amanatides and Woo 1987).
template <typename Visit>
void walkBeam(const GridGeometry& grid, const Layers& layers, const Eigen::Vector3d& origin,
              const Eigen::Vector3d& direction, double length, const Visit& visit) {
  constexpr double kNever = 1e30;
  struct Axis {
    Axis(double start, double d, double resolution_m, int count)
        : cell(static_cast<int>(std::floor(start))),
          stride(d != 0.0 ? resolution_m / std::abs(d) : kNever),
          next(d != 0.0 ? stride * (d > 0.0 ? cell + 1 - start : start - cell) : kNever),
          left(d > 0.0 ? count - cell : cell + 1) {}
    void cross() {
      next += stride;
      --left;
    }
    int cell;             // the first
    double stride, next;  // along the ray, m
    int left;             // cells up to the grid's edge
  };
  const Eigen::Vector2d start = (origin.head<2>() - grid.origin) / grid.resolution_m;
  Axis x(start.x(), direction.x(), grid.resolution_m, grid.width);
  Axis y(start.y(), direction.y(), grid.resolution_m, grid.height);
  if (!grid.containsCell(x.cell, y.cell)) {
    return;
  }
  const std::ptrdiff_t step_x = direction.x() > 0.0 ? 1 : -1;
  const std::ptrdiff_t step_y = direction.y() > 0.0 ? grid.width : -grid.width;
  const double level = layers.level(origin.z());
  const double half_rise = 0.5 * direction.z() / layers.thickness_m;  // in a metre of the ray
  const auto layerAt = [&](double twice_along) {
    return layers.atLevel(level + half_rise * twice_along);
  };
  // Most rays stay in one layer.
  const int first_layer = layerAt(0.0);
  const bool one_layer = first_layer >= 0 && first_layer == layerAt(2.0 * length);
  std::size_t index = grid.index(x.cell, y.cell);
  double entered = 0.0;
  while (entered < length && x.left > 0 && y.left > 0) {
    const double leaves = std::min(x.next, y.next);
    const int layer = one_layer ? first_layer : layerAt(entered + std::min(leaves, length));
    if (layer >= 0) {
      visit(index, layer);
    }
    entered = leaves;
    if (x.next < y.next) {
      x.cross();
      index += static_cast<std::size_t>(step_x);
    } else {
      y.cross();
      index += static_cast<std::size_t>(step_y);
    }
  }
}

// Calls visit(cell, how far off `along` it begins, m) for each cell that the ray enters within
// `error` of `along`, in order.
template <typename Visit>
void enteredWithin(const GridGeometry& grid, const Eigen::Vector3d& origin,
                   const Eigen::Vector3d& direction, double along, double error,
                   const Visit& visit) {
  constexpr double kNever = 1e30;
  const Eigen::Vector2d start =
      ((origin + (along - error) * direction).head<2>() - grid.origin) / grid.resolution_m;
  Eigen::Vector2i cell = start.array().floor().cast<int>();
  Eigen::Vector2d next, stride;  // where the ray crosses each axis' next face, m from the start
  for (int axis = 0; axis < 2; ++axis) {
    const double d = direction[axis];
    stride[axis] = d != 0.0 ? grid.resolution_m / std::abs(d) : kNever;
    const double part = start[axis] - cell[axis];
    next[axis] = d != 0.0 ? stride[axis] * (d > 0.0 ? 1.0 - part : part) : kNever;
  }
  while (next.minCoeff() < 2.0 * error) {
    const int axis = next.x() < next.y() ? 0 : 1;
    cell[axis] += direction[axis] > 0.0 ? 1 : -1;
    visit(cell, std::abs(next[axis] - error));
    next[axis] += stride[axis];
  }
}

}  // namespace otter_nav::map
