// Distance to what a vessel must not touch: the query every room shares. Const and thread-safe.
//
// Held at the corners of the cells: there the distance to the nearest occupied square is a
// distance between corners, so its square is a whole number and the transform is exact. Between
// corners the squared distance less |p|^2 is concave (it is the minimum of affine functions, one
// for each occupied point), so interpolating it gives a guaranteed lower bound; where that bound
// is loose (ridges between obstacles, within a cell or so of one) the exact distance is found by
// a scan along the row.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::map {

struct CornerRow;

struct DistanceFieldOptions {
  double max_distance_m = 12.0;  // distances saturate here
  bool unknown_is_occupied = false;
};

// Enough for the field of known water: what stops ask it for are a hull's clearances.
constexpr double kKnownWaterDistanceM = 3.0;

class DistanceField {
 public:
  DistanceField() = default;
  // Exact Euclidean transform. The map's border counts as occupied: leaving the chart is a
  // collision.
  DistanceField(const OccupancyGrid& grid, const DistanceFieldOptions& options);

  // Recomputes after cells changed; equal to a rebuild, in time that grows with the region grown by
  // max_distance_m. `grid` has this field's geometry; what lies outside it is ignored.
  void update(const OccupancyGrid& grid, const CellRectangle& changed);

  // Occupies the cells with their centres within `radius_m` of `place`, as if they had been mapped.
  void occupy(const Eigen::Vector2d& place, double radius_m);

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  [[nodiscard]] double maxDistance() const { return options_.max_distance_m; }

  // A lower bound, m, of the distance from `p` to the nearest occupied cell, where a cell is its
  // whole square; tight to 0.15 cells or better; 0 inside one and outside the map. 1-Lipschitz
  // use is safe: nothing occupied is nearer to p than this.
  [[nodiscard]] double clearance(const Eigen::Vector2d& p) const;

  // Whether clearance(p) >= clearance_m, for less: ridges need no exact distance then.
  [[nodiscard]] bool isClear(const Eigen::Vector2d& p, double clearance_m) const;

  // A lower bound of the squared distance, m^2, as proofs need it: exact distances are only looked
  // for where the quick bound is below `enough_m2`. Not saturated exactly at max_distance_m.
  [[nodiscard]] double squaredBound(const Eigen::Vector2d& p, double enough_m2) const {
    Bound at;
    if (!bound(p, at)) {
      return 0.0;
    }
    const double cell2 = geometry_.resolution_m * geometry_.resolution_m;
    if (at.squared * cell2 < enough_m2 && !isTight(at)) {
      at.squared = exactSquared(at);
    }
    return std::max(0.0, at.squared - kRounding) * cell2;
  }

  // The distance, m, at the corner south-west of cell (column, row), exact up to rounding; 0 on
  // and inside outlines. Columns 0 to width, rows 0 to height.
  [[nodiscard]] double cornerClearance(int column, int row) const {
    const float distance =
        corner_distance_[static_cast<std::size_t>(row) * static_cast<std::size_t>(corner_width_) +
                         static_cast<std::size_t>(column)];
    return distance > 0.0F ? distance * geometry_.resolution_m : 0.0;
  }

  // Whether that corner is one of an outline: something is on one side of it, water on another.
  [[nodiscard]] bool isOnOutline(int column, int row) const {
    return corner_distance_[static_cast<std::size_t>(row) *
                                static_cast<std::size_t>(corner_width_) +
                            static_cast<std::size_t>(column)] == 0.0F;
  }

  // A smooth (bilinear between cell corners, C0) signed distance in m for optimisation, negative
  // inside obstacles and outside the map, with its gradient (d distance / d p). Not a bound.
  struct Smooth {
    double distance_m = 0.0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  };
  [[nodiscard]] Smooth smooth(const Eigen::Vector2d& p) const;

 private:
  struct Window {
    int x0, y0, x1, y1;  // half open
  };
  // The interpolated bound at a point, all in cells.
  struct Bound {
    double squared;   // of the lower bound; may be negative next to obstacles
    int column, row;  // the cell
    double x, y;      // the point
  };
  // Stored distances are floats; taken off squared distances so that bounds stay bounds.
  static constexpr double kRounding = 1e-3;  // cells^2

  [[nodiscard]] bool bound(const Eigen::Vector2d& p, Bound& out) const;
  [[nodiscard]] bool isTight(const Bound& at) const {
    return tight_[geometry_.index(at.column, at.row)] != 0;
  }
  [[nodiscard]] double exactSquared(const Bound& at) const;

  void markOccupied(const OccupancyGrid& grid, const Window& cells);
  void spread(const Window& cells);
  void markCorners(const Window& corners);
  void transform(const Window& changed_cells);
  void judgeRow(int row, const Window& corners, const CornerRow& south, const CornerRow& north);

  GridGeometry geometry_;
  DistanceFieldOptions options_;
  double inverse_resolution_ = 0.0;
  int cap_ = 0;           // cells; distances saturate here, a little beyond max_distance_m
  int corner_width_ = 0;  // width + 1
  // Signed distance of each cell corner to the nearest corner on an outline, in cells.
  std::vector<float> corner_distance_;
  std::vector<std::uint8_t> tight_;  // cells where the interpolated bound is within 0.15 cells
  // What the transform is made from, kept for update(): see src/map/distance_transform.hpp.
  std::vector<std::uint8_t> occupied_;
  std::vector<std::uint16_t> up_, down_;  // steps in the column to an occupied cell, 0 if it is one
  std::vector<std::uint8_t> corner_kind_;
  std::vector<std::uint16_t> corner_up_, corner_down_;
};

// With squared corner distances e and the point at (fx, fy) in the cell, the bound is
// interpolation(e) - fx (1 - fx) - fy (1 - fy). False outside the map.
inline bool DistanceField::bound(const Eigen::Vector2d& p, Bound& out) const {
  const double x = (p.x() - geometry_.origin.x()) * inverse_resolution_;
  const double y = (p.y() - geometry_.origin.y()) * inverse_resolution_;
  if (!(x >= 0.0 && y >= 0.0 && x < geometry_.width && y < geometry_.height)) {
    return false;
  }
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const double fx = x - column;
  const double fy = y - row;
  const float* corner =
      &corner_distance_[static_cast<std::size_t>(row) * static_cast<std::size_t>(corner_width_) +
                        static_cast<std::size_t>(column)];
  const auto squared = [](float distance) {
    const double outside = std::max(distance, 0.0F);
    return outside * outside;
  };
  const double south = squared(corner[0]) + fx * (squared(corner[1]) - squared(corner[0]));
  const float* above = corner + corner_width_;
  const double north = squared(above[0]) + fx * (squared(above[1]) - squared(above[0]));
  out = {south + fy * (north - south) - fx * (1.0 - fx) - fy * (1.0 - fy), column, row, x, y};
  return true;
}

// The least squared distance there can be between two points `length` apart whose squared
// distances are at least a and b: along a line the squared distance less the squared arc length is
// concave, so at a share k of the way it is at least (1 - k) a + k b - k (1 - k) length^2.
inline double leastSquaredBetween(double a, double b, double length) {
  const double l2 = length * length;
  if (std::abs(a - b) >= l2) {
    return std::min(a, b);
  }
  const double k = 0.5 * (1.0 + (a - b) / l2);
  return (1.0 - k) * a + k * b - k * (1.0 - k) * l2;
}

// Whether the straight segment keeps `clearance_m` from everything occupied. Proven, not sampled:
// between two points the concavity above bounds the distance from below. A segment that clears by
// less than about a millimetre may be refused.
[[nodiscard]] bool segmentIsClear(const DistanceField& field, const Eigen::Vector2d& from,
                                  const Eigen::Vector2d& to, double clearance_m);

}  // namespace otter_nav::map
