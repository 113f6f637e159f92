// What a plant lets the world know, in the project's outside frames (docs/plant.md).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/scripted_vessel.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::plant {

// Map frame ENU, body frame FLU (REP-103); base_link is the hull's middle at the waterline of the
// empty hull. SI units, radians.
struct Truth {
  double stamp_s = 0.0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // z: heave, up, from the mean water level
  double roll_rad = 0.0;                               // starboard down is positive
  double pitch_rad = 0.0;                              // bow down is positive
  double yaw_rad = 0.0;                                // in [-pi, pi], counter-clockwise from east
  Eigen::Vector3d velocity_in_body = Eigen::Vector3d::Zero();  // over ground
  Eigen::Vector3d angular_velocity_in_body = Eigen::Vector3d::Zero();
  // [x y psi u v r]: u and v are the horizontal velocity over ground along and across the heading.
  vessel::State planar = vessel::State::Zero();
  vessel::Thrusts thrusts_n = vessel::Thrusts::Zero();    // acting now, left and right
  Eigen::Vector2d wind_mps = Eigen::Vector2d::Zero();     // velocity of the air, map frame
  Eigen::Vector2d current_mps = Eigen::Vector2d::Zero();  // velocity of the water, map frame
};

// A hull that leans so far is on its way over: nothing the thrusters do rights it, and its lidar
// looks into the water or the sky.
constexpr double kCapsizedRad = 1.0;
[[nodiscard]] inline bool capsized(double roll_rad, double pitch_rad) {
  return std::max(std::abs(roll_rad), std::abs(pitch_rad)) > kCapsizedRad;
}

// What a navigation system reports: late and noisy where the options say so.
struct Odometry {
  double stamp_s = 0.0;  // the instant it describes; it is available latency_s later
  vessel::State state = vessel::State::Zero();
  double z_m = 0.0;
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
};

// Another vessel as it is now.
struct OtherVessel {
  int id = 0;
  vessel::Hull hull;
  vessel::ScriptedMotion motion;
};

}  // namespace otter_nav::plant
