#include "wind.hpp"

#include <algorithm>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::plant {

Wind::Wind(const WindOptions& options, std::uint64_t seed)
    : options_(options),
      random_(seed),
      slow_speed_(options.slow_deviation_mps, options.slow_time_s),
      slow_direction_(options.direction_deviation_rad, options.slow_time_s),
      gust_(options.gust_intensity * options.speed_mps, options.gust_time_s) {
  slow_speed_.start(random_);
  slow_direction_.start(random_);
  gust_.start(random_);
}

void Wind::advance(double dt_s) {
  slow_speed_.advance(dt_s, random_);
  slow_direction_.advance(dt_s, random_);
  gust_.advance(dt_s, random_);
}

Eigen::Vector2d Wind::velocity() const {
  const double speed = std::max(0.0, options_.speed_mps + slow_speed_.value() + gust_.value());
  const double direction = options_.direction_rad + slow_direction_.value();
  return speed * unitVector(direction);
}

}  // namespace otter_nav::plant
