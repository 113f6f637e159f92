// Small waters and trajectories for the mission's tests.
#pragma once

#include <cmath>
#include <vector>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/map/occupancy_grid.hpp"
#include "otter_nav/trajectory/trajectory.hpp"

namespace otter_nav::mission::test {

// Open water, `size_m` square, centred on the origin.
inline map::OccupancyGrid openWater(double size_m = 100.0) {
  map::OccupancyGrid grid;
  const int cells = static_cast<int>(size_m / 0.25);
  grid.geometry = {cells, cells, 0.25, Eigen::Vector2d::Constant(-0.5 * size_m)};
  grid.cells.assign(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells),
                    map::Cell::kFree);
  return grid;
}

// Fills the rectangle from `low` to `high`.
inline void block(map::OccupancyGrid& grid, const Eigen::Vector2d& low,
                  const Eigen::Vector2d& high) {
  const Eigen::Vector2i first = grid.geometry.cellAt(low);
  const Eigen::Vector2i last = grid.geometry.cellAt(high);
  for (int row = first.y(); row <= last.y(); ++row) {
    for (int column = first.x(); column <= last.x(); ++column) {
      grid.cells[grid.geometry.index(column, row)] = map::Cell::kOccupied;
    }
  }
}

inline map::DistanceField fieldOf(const map::OccupancyGrid& grid) {
  return {grid, {12.0, false}};
}

// From rest at `from` along east to rest `length_m` further: `speed_mps` between two ramps of 4 s.
inline trajectory::Trajectory eastward(const Eigen::Vector2d& from, double length_m,
                                       double speed_mps) {
  constexpr double kRampS = 4.0;
  const Eigen::Vector2d ramp(0.5 * speed_mps * kRampS, 0.0);
  const double cruise_m = length_m - 2.0 * ramp.x();
  vessel::FlatPoint start;
  start.position = from;
  vessel::FlatPoint fast;
  fast.position = from + ramp;
  fast.velocity = {speed_mps, 0.0};
  vessel::FlatPoint slow = fast;
  slow.position.x() += cruise_m;
  vessel::FlatPoint end;
  end.position = from + Eigen::Vector2d(length_m, 0.0);
  return trajectory::Trajectory({trajectory::hermitePiece(start, fast, kRampS),
                                 trajectory::hermitePiece(fast, slow, cruise_m / speed_mps),
                                 trajectory::hermitePiece(slow, end, kRampS)});
}

// Part of a circle at constant speed, from the angle of `from_rad` on, to port.
inline trajectory::Trajectory circle(double radius_m, double speed_mps, double duration_s) {
  const double rate = speed_mps / radius_m;
  const auto at = [&](double t) {
    const double a = rate * t;
    vessel::FlatPoint z;
    z.position = radius_m * Eigen::Vector2d(std::sin(a), 1.0 - std::cos(a));
    z.velocity = speed_mps * Eigen::Vector2d(std::cos(a), std::sin(a));
    z.acceleration = speed_mps * rate * Eigen::Vector2d(-std::sin(a), std::cos(a));
    z.jerk = speed_mps * rate * rate * Eigen::Vector2d(-std::cos(a), -std::sin(a));
    return z;
  };
  std::vector<trajectory::Piece> pieces;
  const int count = static_cast<int>(std::ceil(duration_s));
  for (int k = 0; k < count; ++k) {
    pieces.push_back(trajectory::hermitePiece(at(k), at(k + 1.0), 1.0));
  }
  return trajectory::Trajectory(std::move(pieces));
}

}  // namespace otter_nav::mission::test
