#pragma once

#include <Eigen/Geometry>

namespace otter_nav {

// The level frame's axes from the body's: turned by yaw, then pitch, then roll.
[[nodiscard]] inline Eigen::Quaterniond attitude(double roll_rad, double pitch_rad,
                                                 double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
}

}  // namespace otter_nav
