// Differential flatness of the paper's model (section III-B; worked out in docs/model.md): the
// position z(t) in the earth frame and its derivatives give every state and input.
//
//   w   = m1 z'' + d2 (z' - c)        points along the hull, ahead or astern
//   psi = angle of w, or of -w         (the sway equation holds for both)
//   r   = w x w' / |w|^2,  tau_u = m1 z''.e + d1 (z' - c).e,  tau_r = m2 r' + d3 r
// with c the current and e the heading's unit vector.
#pragma once

#include <Eigen/Core>

#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::vessel {

// z and its first four derivatives, earth frame, SI.
struct FlatPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  Eigen::Vector2d acceleration = Eigen::Vector2d::Zero();
  Eigen::Vector2d jerk = Eigen::Vector2d::Zero();
  Eigen::Vector2d snap = Eigen::Vector2d::Zero();
};

struct FlatState {
  State state = State::Zero();  // velocities over ground
  Tau tau;
  // |w| in N: below kSingularForce the heading follows the course, and a turning path would need
  // an unbounded yaw rate (yaw_rate and tau are then computed for a straight one).
  double heading_force_n = 0.0;
};

// Far above rounding, which where |w| passes through zero would turn into a yaw acceleration, and
// far below what a turning way may have.
constexpr double kSingularForceN = 0.05;

// The branch of the heading is the one within 90 degrees of `ahead`, any vector that points
// roughly to where the bow is (the velocity through the water when sailing ahead).
[[nodiscard]] FlatState stateFromFlat(const FlatPoint& z, const PaperModel& model,
                                      const Eigen::Vector2d& ahead,
                                      const Eigen::Vector2d& current_mps = Eigen::Vector2d::Zero());

}  // namespace otter_nav::vessel
