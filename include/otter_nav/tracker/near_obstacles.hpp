// What lies still near the hull, for the plan of the next seconds to keep off.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace otter_nav::tracker {

// More take the control loop too long.
constexpr std::size_t kMostNearObstacles = 500;

struct NearObstacles {
  double start_s = 0.0;                 // in force from then on
  std::vector<Eigen::Vector2d> points;  // of outlines, m, map frame
};

}  // namespace otter_nav::tracker
