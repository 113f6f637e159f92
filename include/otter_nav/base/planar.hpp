// Small vector algebra of the plane.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace otter_nav {

// The third component of a x b: positive when b lies to the left of a.
[[nodiscard]] inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// `v` turned to the left by a right angle.
[[nodiscard]] inline Eigen::Vector2d across(const Eigen::Vector2d& v) {
  return {-v.y(), v.x()};
}

// From the x axis to the left; and the vector of length 1 at such an angle.
[[nodiscard]] inline double angleOf(const Eigen::Vector2d& v) {
  return std::atan2(v.y(), v.x());
}
[[nodiscard]] inline Eigen::Vector2d unitVector(double angle_rad) {
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

// `v` turned to the left.
[[nodiscard]] inline Eigen::Vector2d turned(const Eigen::Vector2d& v, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

[[nodiscard]] inline double lengthOf(const std::vector<Eigen::Vector2d>& polyline) {
  double length = 0.0;
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    length += (polyline[i] - polyline[i - 1]).norm();
  }
  return length;
}

}  // namespace otter_nav
