#include "otter_nav/plant/world_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace otter_nav::plant {
namespace {

constexpr int kSaturation = 255;
constexpr double kOpenCells = std::numeric_limits<double>::infinity();

// Where a ray, in cells, enters and leaves the strip [low, high] of one axis.
void clip(double from, double direction, double low, double high, double& enter, double& leave) {
  if (direction == 0.0) {
    if (from < low || from > high) {
      leave = -kOpenCells;
    }
    return;
  }
  const double a = (low - from) / direction;
  const double b = (high - from) / direction;
  enter = std::max(enter, std::min(a, b));
  leave = std::min(leave, std::max(a, b));
}

int cellOf(double coordinate, int count) {
  return std::clamp(static_cast<int>(std::floor(coordinate)), 0, count - 1);
}

// One axis of the traversal.
struct Axis {
  double from;
  double inverse;  // of the direction; infinite if the ray does not move along this axis
  double direction;
  int cell;

  // The ray's parameter where it leaves the square of free cells around the present one.
  [[nodiscard]] double exit(int free_cells) const {
    if (direction == 0.0) {
      return kOpenCells;
    }
    const int edge = direction > 0.0 ? cell + free_cells : cell - free_cells + 1;
    return (edge - from) * inverse;
  }
  void leave(int free_cells) { cell += direction > 0.0 ? free_cells : -free_cells; }
  // The cell at `t`, still inside the square.
  void follow(double t, int free_cells) {
    const int now = static_cast<int>(std::floor(from + direction * t));
    cell = std::clamp(now, cell - free_cells + 1, cell + free_cells - 1);
  }
};

}  // namespace

// Two chamfer sweeps with unit weights on all eight neighbours are exact for this metric.
WorldMap::WorldMap(const map::OccupancyGrid& grid) : geometry_(grid.geometry) {
  const int width = geometry_.width;
  const int height = geometry_.height;
  distance_.resize(grid.cells.size());
  std::transform(grid.cells.begin(), grid.cells.end(), distance_.begin(), [](map::Cell cell) {
    return static_cast<std::uint8_t>(cell == map::Cell::kOccupied ? 0 : kSaturation);
  });
  const auto relax = [&](int column, int row, int from_column, int from_row) {
    if (geometry_.containsCell(from_column, from_row)) {
      std::uint8_t& here = distance_[geometry_.index(column, row)];
      const int through = distance_[geometry_.index(from_column, from_row)] + 1;
      here = static_cast<std::uint8_t>(std::min<int>(here, through));
    }
  };
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      relax(column, row, column - 1, row);
      for (int side = -1; side <= 1; ++side) relax(column, row, column + side, row - 1);
    }
  }
  for (int row = height - 1; row >= 0; --row) {
    for (int column = width - 1; column >= 0; --column) {
      relax(column, row, column + 1, row);
      for (int side = -1; side <= 1; ++side) relax(column, row, column + side, row + 1);
    }
  }
}

double WorldMap::castRay(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                         double range_m) const {
  if (distance_.empty()) {
    return kOpenCells;
  }
  const Eigen::Vector2d start = (from - geometry_.origin) / geometry_.resolution_m;
  double t = 0.0;
  double end = range_m / geometry_.resolution_m;
  clip(start.x(), direction.x(), 0.0, geometry_.width, t, end);
  clip(start.y(), direction.y(), 0.0, geometry_.height, t, end);
  Axis x{start.x(), 1.0 / direction.x(), direction.x(),
         cellOf(start.x() + t * direction.x(), geometry_.width)};
  Axis y{start.y(), 1.0 / direction.y(), direction.y(),
         cellOf(start.y() + t * direction.y(), geometry_.height)};
  while (t <= end) {
    if (!geometry_.containsCell(x.cell, y.cell)) {
      break;
    }
    const int free_cells = distance_[geometry_.index(x.cell, y.cell)];
    if (free_cells == 0) {
      return t * geometry_.resolution_m;
    }
    const double exit_x = x.exit(free_cells);
    const double exit_y = y.exit(free_cells);
    if (exit_x < exit_y) {
      t = exit_x;
      y.follow(t, free_cells);
      x.leave(free_cells);
    } else {
      t = exit_y;
      x.follow(t, free_cells);
      y.leave(free_cells);
    }
  }
  return kOpenCells;
}

}  // namespace otter_nav::plant
