#include "otter_nav/feasibility/edge_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "otter_nav/base/parts.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::feasibility {
namespace {

constexpr double kInstantsPerSecond = 5.0;
constexpr int kFewestInstants = 4;
// Bent edges.
constexpr double kBentStepS = 0.1;
constexpr double kRebuiltMps = 0.3;     // slower, the pieces at start and goal are rebuilt anyway
constexpr double kTurningRadps = 0.15;  // a course turning less counts as straight
constexpr double kTurnShare = 0.75;     // of the limit
constexpr double kLeastForceShare = 0.02;  // |w| while turning, of both thrusters ahead

}  // namespace

EdgeCheck::EdgeCheck(const vessel::Parameters& vessel)
    : vessel_(vessel), inverse_(vessel), walk_(limits_) {}

void EdgeCheck::begin(const Obstacles& obstacles, const SafetyLimits& limits) {
  obstacles_ = obstacles;
  limits_ = limits;
  inverse_ = vessel::InverseDynamics(vessel_, limits.disturbance);
  walk_ = PieceWalk(limits);
  least_force_n_ = leastHeadingForce(vessel_, limits, kLeastForceShare);
  force_ahead_n_ = 2.0 * limits.thrust_share * vessel_.thrusters.ahead_max_n;
  force_astern_n_ = 2.0 * limits.thrust_share * vessel_.thrusters.astern_max_n;
}

// Position, velocity and acceleration alone: a third of the work of Piece::flat, in the hottest
// loop of the search.
EdgeCheck::Motion EdgeCheck::motionAt(const trajectory::Piece& piece, double t_s) {
  Motion m{piece.position.col(trajectory::kDegree), Eigen::Vector2d::Zero(),
           Eigen::Vector2d::Zero()};
  for (int k = trajectory::kDegree - 1; k >= 0; --k) {
    m.acceleration = m.acceleration * t_s + m.velocity;
    m.velocity = m.velocity * t_s + m.position;
    m.position = m.position * t_s + piece.position.col(k);
  }
  m.acceleration *= 2.0;
  return m;
}

EdgeFault EdgeCheck::checkMotion(const Motion& motion, double time_s) const {
  const double speed_max = speedMax(time_s);
  if (motion.velocity.squaredNorm() > speed_max * speed_max) {
    return EdgeFault::kSpeed;
  }
  const Eigen::Vector2d through = inverse_.throughWater(motion.velocity);
  const Eigen::Vector2d force = inverse_.push(through, motion.velocity, motion.acceleration);
  const double limit = force.dot(through) >= 0.0 ? force_ahead_n_ : force_astern_n_;
  return force.squaredNorm() > limit * limit ? EdgeFault::kForce : EdgeFault::kNone;
}

EdgeFault EdgeCheck::check(const trajectory::Piece& piece, double start_s) const {
  constexpr std::array<double, 3> kFirst = {0.5, 0.25, 0.75};
  for (const double share : kFirst) {
    const double t = share * piece.duration_s;
    const EdgeFault fault = checkMotion(motionAt(piece, t), start_s + t);
    if (fault != EdgeFault::kNone) {
      return fault;
    }
  }
  const int instants =
      std::max(kFewestInstants, static_cast<int>(piece.duration_s * kInstantsPerSecond));
  for (int i = 1; i <= instants; ++i) {
    const double t = piece.duration_s * i / instants;
    const EdgeFault fault = checkMotion(motionAt(piece, t), start_s + t);
    if (fault != EdgeFault::kNone) {
      return fault;
    }
  }
  return isClear(piece, start_s) ? EdgeFault::kNone : EdgeFault::kClearance;
}

EdgeFault EdgeCheck::checkTurning(const vessel::FlatPoint& z) const {
  const Eigen::Vector2d through = inverse_.throughWater(z.velocity);
  const double speed = z.velocity.norm();
  if (speed < kRebuiltMps) {
    return EdgeFault::kNone;
  }
  const double floor = least_force_n_;
  const Eigen::Vector2d w = inverse_.headingForce(z.velocity, z.acceleration);
  const Eigen::Vector2d w1 = inverse_.headingForceRate(z.acceleration, z.jerk);
  const double force2 = w.squaredNorm();
  if (std::abs(cross(w, w1)) >
      kTurnShare * limits_.yaw_rate_max_radps * std::max(force2, floor * floor)) {
    return EdgeFault::kYawRate;
  }
  const double turning = std::abs(cross(z.velocity, z.acceleration)) / (speed * speed);
  const bool undefined = w.dot(through) < 0.0 || force2 < floor * floor;
  return turning > kTurningRadps && undefined ? EdgeFault::kHeading : EdgeFault::kNone;
}

EdgeFault EdgeCheck::checkBent(const trajectory::Piece& piece, double start_s) const {
  const int steps = partsOf(piece.duration_s, kBentStepS, 2);
  for (int i = 0; i <= steps; ++i) {
    const double t = piece.duration_s * i / steps;
    const vessel::FlatPoint z = piece.flat(t);
    EdgeFault fault = checkMotion({z.position, z.velocity, z.acceleration}, start_s + t);
    fault = fault == EdgeFault::kNone ? checkTurning(z) : fault;
    if (fault != EdgeFault::kNone) {
      return fault;
    }
  }
  return isClear(piece, start_s) ? EdgeFault::kNone : EdgeFault::kClearance;
}

bool EdgeCheck::isClear(const trajectory::Piece& piece, double start_s) const {
  const auto bow = [&](double t) -> Eigen::Vector2d {
    const Motion m = motionAt(piece, t);
    const Eigen::Vector2d w = inverse_.headingForce(m.velocity, m.acceleration);
    const Eigen::Vector2d along = w.squaredNorm() > 1e-6 ? w : inverse_.throughWater(m.velocity);
    return along / std::max(along.norm(), 1e-6);
  };
  return !walk_.along(piece, 0.0, *obstacles_, start_s, 0.0, bow).conflict_s;
}

bool EdgeCheck::isFree(const Eigen::Vector2d& position, double time_s) const {
  return obstacles_->clearance(position, time_s) >= limits_.clearance_m + kLeastSlackM;
}

}  // namespace otter_nav::feasibility
