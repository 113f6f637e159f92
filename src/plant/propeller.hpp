// A fixed-pitch propeller in bollard pull (Fossen 2021, section 9.1): T = k |n| n, with its own k
// ahead and astern, and a saturated shaft speed.
#pragma once

#include <algorithm>
#include <cmath>

namespace otter_nav::plant {

struct Propeller {
  double ahead_coefficient;   // N s^2
  double astern_coefficient;  // N s^2
  double ahead_max_n;
  double astern_max_n;  // a positive number

  [[nodiscard]] double maxSpeed() const { return std::sqrt(ahead_max_n / ahead_coefficient); }
  [[nodiscard]] double minSpeed() const { return -std::sqrt(astern_max_n / astern_coefficient); }
  [[nodiscard]] double saturate(double speed_radps) const {
    return std::clamp(speed_radps, minSpeed(), maxSpeed());
  }
  [[nodiscard]] double thrust(double speed_radps) const {
    const double k = speed_radps > 0.0 ? ahead_coefficient : astern_coefficient;
    return k * std::abs(speed_radps) * speed_radps;
  }
  // The shaft speed that gives a thrust, saturated.
  [[nodiscard]] double speedFor(double thrust_n) const {
    const double speed = thrust_n > 0.0 ? std::sqrt(thrust_n / ahead_coefficient)
                                        : -std::sqrt(-thrust_n / astern_coefficient);
    return saturate(speed);
  }
};

}  // namespace otter_nav::plant
