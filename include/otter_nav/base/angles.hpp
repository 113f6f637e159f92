// Angles in radians.
#pragma once

#include <cmath>

namespace otter_nav {

constexpr double kPi = 3.14159265358979323846;

// The same direction in [-pi, pi].
inline double wrapAngle(double angle_rad) {
  return std::abs(angle_rad) < kPi ? angle_rad : std::remainder(angle_rad, 2.0 * kPi);
}

// The angle equal to `angle_rad` modulo a full turn that lies nearest to `reference_rad`.
inline double unwrapNear(double angle_rad, double reference_rad) {
  return reference_rad + wrapAngle(angle_rad - reference_rad);
}

}  // namespace otter_nav
