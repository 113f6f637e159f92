#include "otter_nav/feasibility/edge_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::feasibility {
namespace {

constexpr double kInstantsPerSecond = 5.0;
constexpr int kFewestInstants = 4;
// The smallest jump, as a way at the edge's greatest speed.
constexpr double kHullSlackM = 0.02;

}  // namespace

EdgeCheck::EdgeCheck(const EdgeLimits& limits, const vessel::Parameters& vessel)
    : limits_(limits),
      inverse_(vessel),
      end_offset_m_(0.25 * vessel.hull.length_m),
      disc_radius_m_(std::hypot(0.25 * vessel.hull.length_m, 0.5 * vessel.hull.beam_m)),
      circumscribed_m_(vessel::circumscribedRadius(vessel.hull)) {}

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

EdgeFault EdgeCheck::checkMotion(const Motion& motion) const {
  const double speed2 = motion.velocity.squaredNorm();
  if (speed2 > limits_.speed_max_mps * limits_.speed_max_mps) {
    return EdgeFault::kSpeed;
  }
  const Eigen::Vector2d force = inverse_.surgeForce(motion.velocity, motion.acceleration);
  const double limit =
      force.dot(motion.velocity) >= 0.0 ? limits_.force_ahead_n : limits_.force_astern_n;
  return force.squaredNorm() > limit * limit ? EdgeFault::kThrust : EdgeFault::kNone;
}

// How far the hull may still move before it could touch, m.
double EdgeCheck::slack(const Motion& motion) const {
  const double centre = field_->clearance(motion.position);
  const double left = centre - limits_.clearance_m;
  if (left < 0.0 || centre >= circumscribed_m_) {
    return left;
  }
  const Eigen::Vector2d w = inverse_.headingForce(motion.velocity, motion.acceleration);
  const Eigen::Vector2d along = w.squaredNorm() > 1e-6 ? w : motion.velocity;
  const double norm = along.norm();
  if (norm < 1e-6) {
    return left;
  }
  const Eigen::Vector2d offset = along * (end_offset_m_ / norm);
  const double ends = std::min(field_->clearance(motion.position + offset),
                               field_->clearance(motion.position - offset));
  return std::min(left, ends - disc_radius_m_);
}

EdgeFault EdgeCheck::check(const trajectory::Piece& piece) const {
  constexpr std::array<double, 3> kFirst = {0.5, 0.25, 0.75};
  for (const double share : kFirst) {
    const EdgeFault fault = checkMotion(motionAt(piece, share * piece.duration_s));
    if (fault != EdgeFault::kNone) {
      return fault;
    }
  }
  const int instants =
      std::max(kFewestInstants, static_cast<int>(piece.duration_s * kInstantsPerSecond));
  for (int i = 1; i <= instants; ++i) {
    const double t = piece.duration_s * i / instants;
    const EdgeFault fault = checkMotion(motionAt(piece, t));
    if (fault != EdgeFault::kNone) {
      return fault;
    }
  }
  return isClear(piece) ? EdgeFault::kNone : EdgeFault::kCollision;
}

bool EdgeCheck::isClear(const trajectory::Piece& piece) const {
  double t = 0.0;
  while (true) {
    const double left = slack(motionAt(piece, t));
    if (left < 0.0) {
      return false;
    }
    if (t >= piece.duration_s) {
      return true;
    }
    t = std::min(piece.duration_s, t + std::max(left, kHullSlackM) / limits_.speed_max_mps);
  }
}

bool EdgeCheck::isFree(const Eigen::Vector2d& position) const {
  return field_->clearance(position) >= limits_.clearance_m;
}

}  // namespace otter_nav::feasibility
