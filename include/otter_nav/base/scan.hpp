// A lidar's scan, with the figures of sensor_msgs/LaserScan.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

namespace otter_nav {

// ranges_m[i] is the beam at angle_min_rad + i * angle_increment_rad in the lidar's own plane.
// REP-117: +inf is free water up to range_max, -inf (too close) and NaN (no measurement) say
// nothing.
struct Scan {
  double angle_min_rad = 0.0;
  double angle_increment_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;

  // The beam's direction in the lidar's frame.
  [[nodiscard]] Eigen::Vector3d direction(std::size_t i) const {
    const double angle = angle_min_rad + angle_increment_rad * static_cast<double>(i);
    return {std::cos(angle), std::sin(angle), 0.0};
  }
  [[nodiscard]] bool metSomething(std::size_t i) const {
    const double range = ranges_m[i];
    return range >= range_min_m && range <= range_max_m;
  }
  [[nodiscard]] bool metNothing(std::size_t i) const {
    return std::isinf(ranges_m[i]) && ranges_m[i] > 0.0F;
  }
};

// Why its figures can't be those of a scan; empty if they can.
[[nodiscard]] std::string whyUnusable(const Scan& scan);
// Why it shows nothing, free water included, though it may be a scan; empty if it shows something.
[[nodiscard]] std::string whyBlind(const Scan& scan);

}  // namespace otter_nav
