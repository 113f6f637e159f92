#include "optimizer/ends/forced_motion.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::optimizer {
namespace {

constexpr double kStepS = 0.02;      // of Runge and Kutta's method
constexpr double kPieceS = 0.25;     // a piece lasts no longer
constexpr double kShortestS = 1e-4;  // joints nearer than this are one

}  // namespace

Glide::Surge Glide::surge(double t_s) const {
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

Eigen::Vector4d Glide::heading(double t_s, double within_s) const {
  return turn_ == nullptr ? Eigen::Vector4d(Eigen::Vector4d::Zero()) : turn_->at(t_s, within_s);
}

Eigen::Vector2d Glide::acceleration(const Eigen::Vector2d& velocity, double t_s,
                                    double within_s) const {
  const double psi = heading(t_s, within_s)[0];
  const Eigen::Vector2d bow(std::cos(psi), std::sin(psi));
  const Eigen::Vector2d port(-bow.y(), bow.x());
  return ((surge(t_s).force_n - model_.d1_kgps * bow.dot(velocity)) * bow -
          model_.d2_kgps * port.dot(velocity) * port) /
         model_.m1_kg;
}

Glide::Motion Glide::integrate(const Motion& motion, double from_s, double to_s) const {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(to_s - from_s) / kStepS)));
  const double h = (to_s - from_s) / steps;
  const double within = 0.5 * (from_s + to_s);
  Motion now = motion;
  for (int i = 0; i < steps; ++i) {
    const double t = from_s + h * i;
    const Eigen::Vector2d v1 = now.velocity;
    const Eigen::Vector2d a1 = acceleration(v1, t, within);
    const Eigen::Vector2d v2 = v1 + 0.5 * h * a1;
    const Eigen::Vector2d a2 = acceleration(v2, t + 0.5 * h, within);
    const Eigen::Vector2d v3 = v1 + 0.5 * h * a2;
    const Eigen::Vector2d a3 = acceleration(v3, t + 0.5 * h, within);
    const Eigen::Vector2d v4 = v1 + h * a3;
    const Eigen::Vector2d a4 = acceleration(v4, t + h, within);
    now.position += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
    now.velocity += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  return now;
}

vessel::FlatPoint Glide::flat(const Motion& motion, double t_s) const {
  const Eigen::Vector4d turned = heading(t_s, t_s);
  const double r = turned[1];
  const Eigen::Vector2d bow(std::cos(turned[0]), std::sin(turned[0]));
  const Eigen::Vector2d port(-bow.y(), bow.x());
  const Surge force = surge(t_s);
  const Eigen::Vector2d& v = motion.velocity;
  vessel::FlatPoint z;
  z.position = motion.position;
  z.velocity = v;
  z.acceleration = acceleration(v, t_s, t_s);
  // The derivative of m1 z'' = tau_u e - d1 (e . z') e - d2 (p . z') p, with e' = r p, p' = -r e.
  const double ahead = bow.dot(v);
  const double aside = port.dot(v);
  const double ahead1 = r * aside + bow.dot(z.acceleration);
  const double aside1 = -r * ahead + port.dot(z.acceleration);
  z.jerk = ((force.slope_nps - model_.d1_kgps * ahead1 + model_.d2_kgps * aside * r) * bow +
            ((force.force_n - model_.d1_kgps * ahead) * r - model_.d2_kgps * aside1) * port) /
           model_.m1_kg;
  return z;
}

std::vector<double> Glide::joints(double from_s, double to_s) const {
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
    if (change > to_s || length < kShortestS || (change < to_s && to_s - change < kShortestS)) {
      continue;
    }
    const double start = times.back();
    const int parts = static_cast<int>(std::ceil(length / kPieceS));
    for (int i = 1; i <= parts; ++i) {
      times.push_back(start + length * i / parts);
    }
  }
  return times;
}

trajectory::Piece Glide::piece(const Motion& from, double from_s, const Motion& to,
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
