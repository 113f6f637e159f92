// The vessel's limits (the paper's f_d) as penalties ld max(0, excess)^2, forces in shares of one
// thruster's, astern of what it has astern.
#pragma once

#include <algorithm>
#include <cmath>

#include "optimizer/objective/cost.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::optimizer {

constexpr double kForceKnee = 0.3;   // exceeded by more than this share, it counts linearly
constexpr double kMotionKnee = 1.0;  // of speed, m/s, and yaw rate, rad/s

[[nodiscard]] inline Rows byDerivatives(const vessel::FlatRow& row, double scale) {
  Rows rows;
  rows.col(0).setZero();
  rows.rightCols<4>() = scale * row;
  return rows;
}

// Both thrusters, ahead and astern. What they push with ahead is about the length of the surge
// force, whose curvature across itself is known.
class ThrustLimit final : public Cost {
 public:
  explicit ThrustLimit(const vessel::Thrusters& thrusters)
      : inverse_ahead_(1.0 / thrusters.ahead_max_n),
        inverse_astern_(1.0 /
                        std::max(thrusters.astern_max_n, kLeastAstern * thrusters.ahead_max_n)) {}

  void add(const Targets& targets, Point& point) const override {
    const vessel::FlatGradient& g = point.demand();
    const double weight = targets.weights.dynamics;
    const double kept = targets.keptAt(point.piece.index, point.number);
    double slope_per_n = 0.0;  // of the cost over what both push with ahead
    for (const double side : {-1.0, 1.0}) {
      const double thrust = 0.5 * (g.surge_n + side * g.difference_n);
      for (const double sign : {1.0, -1.0}) {
        const double most =
            (sign > 0.0 ? targets.limits.thrust_ahead_n : targets.limits.thrust_astern_n) - kept;
        const double inverse = sign > 0.0 ? inverse_ahead_ : inverse_astern_;
        const double excess = (sign * thrust - most) * inverse;
        point.addHinge(weight, excess, kForceKnee, [&] {
          return byDerivatives(0.5 * (g.surge + side * g.difference), sign * inverse);
        });
        if (sign > 0.0) {
          slope_per_n += weight * std::clamp(excess, 0.0, kForceKnee) * inverse;
        }
      }
    }
    if (targets.knows_curvature && slope_per_n > 0.0 && point.piece.wanted) {
      const Eigen::Vector2d force =
          point.dynamics.surgeForce(point.path().col(1), point.path().col(2));
      const double force_n = std::max(force.norm(), point.force_floor_n);
      point.piece.addCurvature(
          slope_per_n / force_n,
          point.chain(byDerivatives(point.dynamics.bySurgeForce(across(force) / force_n), 1.0)));
    }
  }

 private:
  // A vessel without thrust astern still has a scale for wanting some.
  static constexpr double kLeastAstern = 0.1;
  double inverse_ahead_;
  double inverse_astern_;
};

class YawRateLimit final : public Cost {
 public:
  void add(const Targets& targets, Point& point) const override {
    const vessel::FlatGradient& g = point.demand();
    point.addHinge(targets.weights.dynamics,
                   std::abs(g.yaw_rate_radps) - targets.limits.yaw_rate_radps, kMotionKnee,
                   [&] { return byDerivatives(g.yaw_rate, g.yaw_rate_radps < 0.0 ? -1.0 : 1.0); });
  }
};

// Over ground; its curvature across the course is known: without it a step along a straight course
// at the limit swings to and fro beside it.
class SpeedLimit final : public Cost {
 public:
  void add(const Targets& targets, Point& point) const override {
    const Eigen::Vector2d velocity = point.path().col(1);
    const double speed = velocity.norm();
    const SplineLimits& limits = targets.limits;
    const double most = limits.slowing.limitAt(point.time_s, limits.speed_mps);
    const double excess = speed - most;
    const double weight = targets.weights.dynamics;
    point.addHinge(weight, excess, kMotionKnee, 1,
                   [&]() -> Eigen::Vector2d { return velocity / speed; });
    if (targets.knows_curvature && excess > 0.0 && point.piece.wanted) {
      point.piece.addCurvature(
          2.0 * weight * std::min(excess, kMotionKnee) / std::max(speed, kSlowMps),
          point.chain(1, across(velocity / speed)));
    }
  }
};

// |w| by its component along the course through the water: a heading against the course counts as
// missing it all.
class HeadingForceLimit final : public Cost {
 public:
  explicit HeadingForceLimit(double force_scale_n) : scale_n_(force_scale_n) {}

  void add(const Targets& targets, Point& point) const override {
    const Eigen::Vector2d velocity = point.path().col(1);
    const Eigen::Vector2d through = point.dynamics.throughWater(velocity);
    const double speed = through.norm();
    if (speed <= 1e-3) {
      return;
    }
    const Eigen::Vector2d course = through / speed;
    const Eigen::Vector2d w = point.dynamics.headingForce(velocity, point.path().col(2));
    const double missing = (targets.limits.heading_force_n - course.dot(w)) / scale_n_;
    point.addHinge(targets.weights.dynamics, missing, kForceKnee, [&] {
      Rows rows = byDerivatives(point.dynamics.byPath(course), -1.0 / scale_n_);
      const Eigen::Vector2d turn = across(course);
      rows.col(1) -= turn.dot(w) / (std::max(speed, kSlowMps) * scale_n_) * turn;
      return rows;
    });
  }

 private:
  double scale_n_;
};

}  // namespace otter_nav::optimizer
