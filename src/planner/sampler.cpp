#include "planner/sampler.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::planner {
Sampler::Sampler(const SamplerOptions& options, const GuideLine& line,
                 const map::DistanceField& field, std::uint64_t seed)
    : options_(options), line_(&line), field_(&field), random_(seed) {
  const double parts = std::ceil(line.length() / options.key_spacing_m);
  key_states_ = std::max(1, static_cast<int>(parts) - 1);
}

KinoState Sampler::next() {
  const int index = drawn_++;
  if (index < key_states_) {
    return keyState(index);
  }
  return random_.uniform() < options_.uniform_share ? anywhere() : inCorridor();
}

// 0 and 1 are next to start and goal, 2 and 3 next to those, and so on.
KinoState Sampler::keyState(int index) const {
  const int rank = index / 2 + 1;
  const int place = index % 2 == 0 ? rank : key_states_ + 1 - rank;
  const GuideLine::Point point = line_->at(line_->length() * place / (key_states_ + 1));
  KinoState state;
  state.position = point.position;
  state.velocity = point.speed_mps * point.direction;
  const Eigen::Vector2d port = across(point.direction);
  state.acceleration = point.speed_mps * point.speed_mps * point.curvature_per_m * port;
  return state;
}

KinoState Sampler::inCorridor() {
  const GuideLine::Point point = line_->at(random_.uniform() * line_->length());
  const Eigen::Vector2d port = across(point.direction);
  const double aside = point.half_width_m * std::clamp(0.4 * random_.normal(), -1.0, 1.0);
  const double speed = std::min(options_.speed_max_mps,
                                point.speed_mps * (1.0 + options_.speed_spread * random_.normal()));
  KinoState state;
  state.position = point.position + aside * port;
  state.velocity =
      std::max(0.0, speed) * turned(point.direction, options_.turn_spread_rad * random_.normal());
  const double ahead = options_.accel_mps2 * random_.normal();
  state.acceleration = ahead * point.direction + options_.accel_mps2 * random_.normal() * port;
  return state;
}

KinoState Sampler::anywhere() {
  const map::GridGeometry& map = field_->geometry();
  const double east = random_.uniform() * map.resolution_m * map.width;
  const double north = random_.uniform() * map.resolution_m * map.height;
  const double speed = random_.uniform() * options_.speed_max_mps;
  const double course = random_.uniform(-kPi, kPi);
  KinoState state;
  state.position = map.origin + Eigen::Vector2d(east, north);
  state.velocity = speed * unitVector(course);
  return state;
}

}  // namespace otter_nav::planner
