#include "optimizer/objective/flat_gradient.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::optimizer {
namespace {

// The gradient of cross(a, b) with respect to a; with respect to b it is -crossRow(a).
Eigen::Vector2d crossRow(const Eigen::Vector2d& b) {
  return {b.y(), -b.x()};
}

// w and its first two derivatives, and what follows from them.
struct Turning {
  Eigen::Vector2d w, w1, w2;
  double norm2, r, along, numerator, yaw_acceleration;

  Turning(const vessel::FlatPoint& z, const vessel::PaperModel& m, double floor_n)
      : w(m.m1_kg * z.acceleration + m.d2_kgps * z.velocity),
        w1(m.m1_kg * z.jerk + m.d2_kgps * z.acceleration),
        w2(m.m1_kg * z.snap + m.d2_kgps * z.jerk),
        norm2(std::max(w.squaredNorm(), floor_n * floor_n)),
        r(cross(w, w1) / norm2),
        along(w.dot(w1)),
        numerator(cross(w, w2) - 2.0 * r * along),
        yaw_acceleration(numerator / norm2) {}
};

}  // namespace

FlatValues flatValues(const vessel::FlatPoint& z, const vessel::Parameters& vessel,
                      double force_floor_n) {
  const vessel::PaperModel& m = vessel.paper;
  const Turning t(z, m, force_floor_n);
  const double norm = std::sqrt(t.norm2);
  const Eigen::Vector2d bow = t.w / norm;
  return {norm, t.r, m.m1_kg * bow.dot(z.acceleration) + m.d1_kgps * bow.dot(z.velocity),
          (m.m2_kgm2 * t.yaw_acceleration + m.d3_kgm2ps * t.r) / vessel.thrusters.lever_arm_m};
}

FlatGradient flatGradient(const vessel::FlatPoint& z, const vessel::Parameters& vessel,
                          double force_floor_n) {
  const vessel::PaperModel& m = vessel.paper;
  const Turning t(z, m, force_floor_n);
  const double inverse2 = 1.0 / t.norm2;
  FlatGradient g;
  g.heading_force_n = std::sqrt(t.norm2);
  g.bow = t.w / g.heading_force_n;

  const Eigen::Vector2d r_w = (crossRow(t.w1) - 2.0 * t.r * t.w) * inverse2;
  const Eigen::Vector2d r_w1 = -crossRow(t.w) * inverse2;
  const Eigen::Vector2d q_w =
      (crossRow(t.w2) - 2.0 * t.along * r_w - 2.0 * t.r * t.w1 - 2.0 * t.yaw_acceleration * t.w) *
      inverse2;
  const Eigen::Vector2d q_w1 = (-2.0 * t.along * r_w1 - 2.0 * t.r * t.w) * inverse2;
  const Eigen::Vector2d& q_w2 = r_w1;

  g.yaw_rate_radps = t.r;
  g.yaw_rate.col(0) = m.d2_kgps * r_w;
  g.yaw_rate.col(1) = m.m1_kg * r_w + m.d2_kgps * r_w1;
  g.yaw_rate.col(2) = m.m1_kg * r_w1;

  g.heading_force.col(0) = m.d2_kgps * g.bow;
  g.heading_force.col(1) = m.m1_kg * g.bow;

  // tau_u = bow . (m1 z'' + d1 z') = |w| + (d1 - d2) bow . z'
  const double extra = m.d1_kgps - m.d2_kgps;
  const double ahead = g.bow.dot(z.velocity);
  const Eigen::Vector2d u_w = g.bow + extra / g.heading_force_n * (z.velocity - ahead * g.bow);
  g.surge_n = m.m1_kg * g.bow.dot(z.acceleration) + m.d1_kgps * ahead;
  g.surge.col(0) = m.d2_kgps * u_w + extra * g.bow;
  g.surge.col(1) = m.m1_kg * u_w;

  const double inverse_lever = 1.0 / vessel.thrusters.lever_arm_m;
  g.difference_n = inverse_lever * (m.m2_kgm2 * t.yaw_acceleration + m.d3_kgm2ps * t.r);
  const double scale = inverse_lever * m.m2_kgm2;
  g.difference = inverse_lever * m.d3_kgm2ps * g.yaw_rate;
  g.difference.col(0) += scale * m.d2_kgps * q_w;
  g.difference.col(1) += scale * (m.m1_kg * q_w + m.d2_kgps * q_w1);
  g.difference.col(2) += scale * (m.m1_kg * q_w1 + m.d2_kgps * q_w2);
  g.difference.col(3) += scale * m.m1_kg * q_w2;
  return g;
}

}  // namespace otter_nav::optimizer
