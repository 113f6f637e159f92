// Distance to what a vessel must not touch: the query every room shares. Const and thread-safe.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::map {

struct DistanceFieldOptions {
  double max_distance_m = 12.0;  // distances saturate here
  bool unknown_is_occupied = false;
};

class DistanceField {
 public:
  DistanceField() = default;
  // Exact Euclidean transform. The map's border counts as occupied: leaving the chart is a
  // collision.
  DistanceField(const OccupancyGrid& grid, const DistanceFieldOptions& options);

  // Recomputes after cells in columns [column, column + width) and rows alike changed; exact, in
  // time that grows with the region grown by max_distance_m.
  void update(const OccupancyGrid& grid, int column, int row, int width, int height);

  [[nodiscard]] const GridGeometry& geometry() const { return geometry_; }
  [[nodiscard]] double maxDistance() const { return options_.max_distance_m; }

  // A lower bound, m, of the distance from `p` to the nearest occupied cell, where a cell is its
  // whole square; tight to 0.15 cells or better; 0 inside one and outside the map. 1-Lipschitz
  // use is safe: nothing occupied is nearer to p than this.
  [[nodiscard]] double clearance(const Eigen::Vector2d& p) const;

  // A smooth (bilinear between cell centres, C0) distance in m for optimisation, negative inside
  // obstacles, with its gradient (d distance / d p). Not a bound.
  struct Smooth {
    double distance_m = 0.0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  };
  [[nodiscard]] Smooth smooth(const Eigen::Vector2d& p) const;

 private:
  GridGeometry geometry_;
  DistanceFieldOptions options_;
  // Signed distance of each cell's centre to the nearest cell of the other kind (centre to
  // centre), m.
  std::vector<float> distance_m_;
};

// Whether the straight segment keeps `clearance_m` from everything occupied: jumps along it by
// the clearance left, so nothing is sampled past a corner.
[[nodiscard]] bool segmentIsClear(const DistanceField& field, const Eigen::Vector2d& from,
                                  const Eigen::Vector2d& to, double clearance_m);

}  // namespace otter_nav::map
