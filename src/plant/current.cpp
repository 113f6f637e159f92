#include "current.hpp"

#include <algorithm>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::plant {

Current::Current(const CurrentOptions& options, std::uint64_t seed)
    : options_(options),
      random_(seed),
      slow_(options.slow_deviation_mps, options.slow_time_s),
      direction_rad_(options.direction_rad) {
  slow_.start(random_);
}

void Current::advance(double dt_s) {
  slow_.advance(dt_s, random_);
  direction_rad_ = wrapAngle(direction_rad_ + options_.turning_radps * dt_s);
}

Eigen::Vector2d Current::velocity() const {
  const double speed = std::max(0.0, options_.speed_mps + slow_.value());
  return speed * unitVector(direction_rad_);
}

}  // namespace otter_nav::plant
