// Small vector algebra of the plane.
#pragma once

#include <Eigen/Core>

namespace otter_nav {

// The third component of a x b: positive when b lies to the left of a.
[[nodiscard]] inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// `v` turned to the left by a right angle.
[[nodiscard]] inline Eigen::Vector2d across(const Eigen::Vector2d& v) {
  return {-v.y(), v.x()};
}

}  // namespace otter_nav
