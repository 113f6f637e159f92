#include "radar.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::plant {

std::vector<Eigen::Vector2d> Radar::scan(const std::vector<OtherVessel>& others,
                                         const Truth& truth) {
  std::vector<Eigen::Vector2d> in_base;
  const Eigen::Rotation2Dd base_from_map(-truth.yaw_rad);
  for (const OtherVessel& other : others) {
    const Eigen::Vector2d off = other.motion.pose.position - truth.position.head<2>();
    const bool seen = random_.uniform() < RadarOptions::kDetectionProbability;
    const Eigen::Vector2d noise(random_.normal(), random_.normal());
    if (seen && off.norm() <= options_.range_m) {
      in_base.emplace_back(base_from_map * off + options_.noise_m * noise);
    }
  }
  // Evenly over the disc.
  if (random_.uniform() < RadarOptions::kFalsePerScan) {
    const double range = options_.range_m * std::sqrt(random_.uniform());
    const double bearing = random_.uniform(-kPi, kPi);
    in_base.emplace_back(range * unitVector(bearing));
  }
  return in_base;
}

}  // namespace otter_nav::plant
