#include "odometry_sensor.hpp"

#include "otter_nav/base/angles.hpp"

namespace otter_nav::plant {

OdometrySensor::OdometrySensor(const OdometryOptions& options, std::uint64_t seed)
    : options_(options), random_(seed) {}

Odometry OdometrySensor::withNoise(const Truth& truth) {
  Odometry odometry{truth.stamp_s, truth.planar, truth.position.z(), truth.roll_rad,
                    truth.pitch_rad};
  const auto add = [&](vessel::StateIndex i, double deviation) {
    if (deviation > 0.0) {
      odometry.state[i] += deviation * random_.normal();
    }
  };
  add(vessel::kX, options_.position_noise_m);
  add(vessel::kY, options_.position_noise_m);
  add(vessel::kPsi, options_.heading_noise_rad);
  add(vessel::kSurge, options_.velocity_noise_mps);
  add(vessel::kSway, options_.velocity_noise_mps);
  add(vessel::kYawRate, options_.yaw_rate_noise_radps);
  odometry.state[vessel::kPsi] = wrapAngle(odometry.state[vessel::kPsi]);
  return odometry;
}

void OdometrySensor::measure(const Truth& truth) {
  constexpr double kStampTolerance = 1e-9;
  const bool first = pending_.empty();
  pending_.push_back(withNoise(truth));
  const double newest = truth.stamp_s - options_.latency_s + kStampTolerance;
  while (pending_.size() > 1 && pending_[1].stamp_s <= newest) {
    pending_.pop_front();
  }
  if (first || pending_.front().stamp_s <= newest) {
    latest_ = pending_.front();
  }
}

}  // namespace otter_nav::plant
