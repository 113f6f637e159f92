#include "optimizer/ends/forced_motion.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/parts.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kRungeKuttaS = 0.05;  // of Runge and Kutta's method
constexpr double kPieceS = 0.25;       // a piece lasts no longer
constexpr double kOneJointS = 1e-4;    // joints nearer than this are one

}  // namespace

ForcedMotion::Surge ForcedMotion::surge(double t_s) const {
  double held = ramps_.front().from_n;
  for (const SurgeRamp& ramp : ramps_) {
    if (t_s < ramp.from_s) {
      break;
    }
    held = ramp.to_n;
    if (t_s < ramp.to_s) {
      const double length = ramp.to_s - ramp.from_s;
      const double x = (t_s - ramp.from_s) / length;
      const double rise = ramp.to_n - ramp.from_n;
      return {ramp.from_n + rise * x * x * (3.0 - 2.0 * x), rise * 6.0 * x * (1.0 - x) / length};
    }
  }
  return {held, 0.0};
}

Eigen::Vector4d ForcedMotion::heading(double t_s, double within_s) const {
  return turn_ == nullptr ? Eigen::Vector4d(Eigen::Vector4d::Zero()) : turn_->at(t_s, within_s);
}

vessel::FlatPoint ForcedMotion::pushed(const Motion& motion, double t_s, double within_s) const {
  const Eigen::Vector4d turned = heading(t_s, within_s);
  const Surge force = surge(t_s);
  vessel::FlatPoint z;
  z.position = motion.position;
  z.velocity = motion.velocity;
  if (paper_holds_) {
    inverse_.push(turned[0], turned[1], force.force_n, force.slope_nps, z);
  } else {
    vessel::push(manoeuvring_, disturbance_, {turned[0], turned[1], turned[2]}, force.force_n,
                 force.slope_nps, z);
  }
  return z;
}

ForcedMotion::Motion ForcedMotion::integrate(const Motion& motion, double from_s,
                                             double to_s) const {
  const int steps = partsOf(std::abs(to_s - from_s), kRungeKuttaS);
  const double h = (to_s - from_s) / steps;
  const double within = 0.5 * (from_s + to_s);
  using Eigen::Vector2d;
  struct Forcing {
    Eigen::Vector4d turned;
    double surge_n;
  };
  const auto forcing = [&](double t) { return Forcing{heading(t, within), surge(t).force_n}; };
  const auto acceleration = [&](const Vector2d& velocity, const Forcing& at) -> Vector2d {
    return paper_holds_ ? inverse_.pushed(at.turned[0], at.surge_n, velocity)
                        : vessel::pushed(manoeuvring_, disturbance_, at.turned[0], at.turned[1],
                                         at.surge_n, velocity);
  };
  Motion now = motion;
  Forcing from = forcing(from_s);
  for (int i = 0; i < steps; ++i) {
    const Forcing middle = forcing(from_s + h * (i + 0.5));
    const Forcing to = forcing(from_s + h * (i + 1));
    const Eigen::Vector2d v1 = now.velocity;
    const Eigen::Vector2d a1 = acceleration(v1, from);
    const Eigen::Vector2d v2 = v1 + 0.5 * h * a1;
    const Eigen::Vector2d a2 = acceleration(v2, middle);
    const Eigen::Vector2d v3 = v1 + 0.5 * h * a2;
    const Eigen::Vector2d a3 = acceleration(v3, middle);
    const Eigen::Vector2d v4 = v1 + h * a3;
    const Eigen::Vector2d a4 = acceleration(v4, to);
    now.position += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
    now.velocity += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    from = to;
  }
  return now;
}

vessel::FlatPoint ForcedMotion::flat(const Motion& motion, double t_s) const {
  return pushed(motion, t_s, t_s);
}

std::vector<double> ForcedMotion::joints(double from_s, double to_s) const {
  std::vector<double> changes = turn_ == nullptr ? std::vector<double>() : turn_->joints();
  for (const SurgeRamp& ramp : ramps_) {
    changes.push_back(ramp.from_s);
    changes.push_back(ramp.to_s);
  }
  changes.push_back(to_s);
  std::sort(changes.begin(), changes.end());
  std::vector<double> times = {from_s};
  for (const double change : changes) {
    const double length = change - times.back();
    if (change > to_s || length < kOneJointS || (change < to_s && to_s - change < kOneJointS)) {
      continue;
    }
    const double start = times.back();
    const int parts = partsOf(length, kPieceS, 0);
    for (int i = 1; i <= parts; ++i) {
      times.push_back(start + length * i / parts);
    }
  }
  return times;
}

trajectory::Piece ForcedMotion::piece(const Motion& from, double from_s, const Motion& to,
                                      double to_s) const {
  const double within = 0.5 * (from_s + to_s);
  const auto turned = [&](double t_s) {
    const Eigen::Vector4d h = heading(t_s, within);
    vessel::FlatPoint z;
    z.position.x() = h[0];
    z.velocity.x() = h[1];
    z.acceleration.x() = h[2];
    z.jerk.x() = h[3];
    return z;
  };
  trajectory::Piece piece =
      trajectory::hermitePiece(flat(from, from_s), flat(to, to_s), to_s - from_s);
  piece.kind = trajectory::PieceKind::kSpin;
  piece.heading =
      trajectory::hermitePiece(turned(from_s), turned(to_s), to_s - from_s).position.row(0);
  return piece;
}

}  // namespace otter_nav::optimizer
