#include "otter_nav/plant/lidar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/attitude.hpp"

namespace otter_nav::plant {
namespace {

// Range at which a beam from `height_m` over the water meets it.
double rangeToWater(double height_m, double rise) {
  if (height_m <= 0.0) {
    return 0.0;
  }
  return rise < 0.0 ? -height_m / rise : std::numeric_limits<double>::infinity();
}

}  // namespace

Lidar::Lidar(const LidarOptions& options, std::uint64_t seed) : options_(options), random_(seed) {
  scan_.angle_min_rad = -kPi;
  scan_.angle_increment_rad = 2.0 * kPi / options.beams;
  scan_.range_min_m = options.range_min_m;
  scan_.range_max_m = options.range_max_m;
  scan_.ranges_m.resize(static_cast<std::size_t>(options.beams));
  for (int i = 0; i < options.beams; ++i) {
    const double angle = scan_.angle_min_rad + i * scan_.angle_increment_rad;
    beams_.emplace_back(std::cos(angle), std::sin(angle));
  }
}

float Lidar::report(double range_m) {
  if (options_.dropout_probability > 0.0 && random_.uniform() < options_.dropout_probability) {
    return std::numeric_limits<float>::quiet_NaN();
  }
  if (std::isinf(range_m)) {
    return std::numeric_limits<float>::infinity();
  }
  const double noise =
      options_.range_noise_m > 0.0 ? options_.range_noise_m * random_.normal() : 0.0;
  const double measured = range_m + noise;
  if (measured < options_.range_min_m) {
    return -std::numeric_limits<float>::infinity();
  }
  return measured > options_.range_max_m ? std::numeric_limits<float>::infinity()
                                         : static_cast<float>(measured);
}

const Scan& Lidar::scan(const WorldMap& world, const OtherVessels& others, const Truth& truth) {
  const Eigen::Matrix3d rotation =
      attitude(truth.roll_rad, truth.pitch_rad, truth.yaw_rad).toRotationMatrix();
  const Eigen::Vector3d eye = truth.position + rotation * options_.position_m;
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    const Eigen::Vector3d beam = rotation.leftCols<2>() * beams_[i];
    const double level = beam.head<2>().norm();  // metres over ground a metre of range
    const double reach = std::min(options_.range_max_m, rangeToWater(eye.z(), beam.z()));
    const Eigen::Vector2d direction = beam.head<2>() / level;
    const double distance = std::min(world.castRay(eye.head<2>(), direction, reach * level),
                                     others.castRay(eye.head<2>(), direction, reach * level));
    scan_.ranges_m[i] = report(distance / level);
  }
  return scan_;
}

}  // namespace otter_nav::plant
