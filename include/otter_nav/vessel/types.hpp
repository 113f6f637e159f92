// States and inputs of a surface vessel in the horizontal plane.
//
// Earth frame: ENU, x east, y north, psi counter-clockwise from east. Body frame: FLU, surge u
// ahead, sway v to port, yaw rate r counter-clockwise (REP-103). SI units throughout.
#pragma once

#include <Eigen/Core>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::vessel {

// Named rows of State.
enum StateIndex : int { kX = 0, kY = 1, kPsi = 2, kSurge = 3, kSway = 4, kYawRate = 5 };
constexpr int kStateSize = 6;
constexpr int kInputSize = 2;

// [x m, y m, psi rad, u m/s, v m/s, r rad/s]: eta, then nu.
using State = Eigen::Matrix<double, kStateSize, 1>;
using StateJacobian = Eigen::Matrix<double, kStateSize, kStateSize>;
// Over ground, earth frame, m/s.
[[nodiscard]] inline Eigen::Vector2d velocityOverGround(const State& state) {
  const Eigen::Vector2d ahead = unitVector(state[kPsi]);
  return state[kSurge] * ahead + state[kSway] * across(ahead);
}
[[nodiscard]] inline double speedOf(const State& state) {
  return state.segment<2>(kSurge).norm();
}
// Thrusts [F_left N, F_right N], positive ahead.
using Thrusts = Eigen::Vector2d;
using InputJacobian = Eigen::Matrix<double, kStateSize, kInputSize>;

enum ThrustIndex : int { kLeft = 0, kRight = 1 };

// Generalised force in the plane: surge force N and yaw moment N m.
struct Tau {
  double surge_n = 0.0;
  double yaw_nm = 0.0;
};

// A point of a path: z and its first four derivatives, earth frame, SI.
struct FlatPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();
  Eigen::Vector2d jerk = Eigen::Vector2d::Zero();
  Eigen::Vector2d snap = Eigen::Vector2d::Zero();
};

}  // namespace otter_nav::vessel
