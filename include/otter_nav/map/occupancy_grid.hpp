// A plane grid of occupancy, the projection every planner works on (nav_msgs/OccupancyGrid's
// layout: row-major from the south-west corner).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace otter_nav::map {

enum class Cell : std::uint8_t { kFree = 0, kOccupied = 1, kUnknown = 2 };

// Cells of columns [column, column + width) and rows alike; empty if width or height is 0.
struct CellRectangle {
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;

  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
  // Grows to hold a cell.
  void include(int at_column, int at_row) {
    if (empty()) {
      *this = {at_column, at_row, 1, 1};
      return;
    }
    width += std::max(column - at_column, 0) + std::max(at_column - column - width + 1, 0);
    height += std::max(row - at_row, 0) + std::max(at_row - row - height + 1, 0);
    column = std::min(column, at_column);
    row = std::min(row, at_row);
  }
};

struct GridGeometry {
  int width = 0;   // cells, east
  int height = 0;  // cells, north
  double resolution_m = 0.25;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // south-west corner of cell (0, 0), map frame

  [[nodiscard]] bool operator==(const GridGeometry& other) const {
    return width == other.width && height == other.height && resolution_m == other.resolution_m &&
           origin == other.origin;
  }
  [[nodiscard]] bool contains(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d q = (p - origin) / resolution_m;
    return q.x() >= 0.0 && q.y() >= 0.0 && q.x() < width && q.y() < height;
  }
  [[nodiscard]] bool containsCell(int column, int row) const {
    return column >= 0 && row >= 0 && column < width && row < height;
  }
  // The cell a point lies in; only meaningful when contains(p).
  [[nodiscard]] Eigen::Vector2i cellAt(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d q = (p - origin) / resolution_m;
    return {static_cast<int>(std::floor(q.x())), static_cast<int>(std::floor(q.y()))};
  }
  [[nodiscard]] Eigen::Vector2d centreOf(int column, int row) const {
    return origin + resolution_m * Eigen::Vector2d(column + 0.5, row + 0.5);
  }
  // The map's cells within `reach_m` of a point, along rows and columns.
  [[nodiscard]] CellRectangle around(const Eigen::Vector2d& p, double reach_m) const {
    const Eigen::Vector2i low =
        cellAt(p - Eigen::Vector2d::Constant(reach_m)).cwiseMax(Eigen::Vector2i::Zero());
    const Eigen::Vector2i high = cellAt(p + Eigen::Vector2d::Constant(reach_m))
                                     .cwiseMin(Eigen::Vector2i(width - 1, height - 1));
    return {low.x(), low.y(), high.x() - low.x() + 1, high.y() - low.y() + 1};
  }
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

struct OccupancyGrid {
  GridGeometry geometry;
  std::vector<Cell> cells;  // width * height, row-major

  [[nodiscard]] Cell at(int column, int row) const { return cells[geometry.index(column, row)]; }
};

}  // namespace otter_nav::map
