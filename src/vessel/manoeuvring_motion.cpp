#include "otter_nav/vessel/manoeuvring_motion.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/steady_motion.hpp"

namespace otter_nav::vessel {
namespace {

using Eigen::Vector2d;

// Of a turn: the rate it reaches, of the one that all the moment holds, and where it is led to, of
// that.
constexpr double kReachedShare = 0.97;
constexpr double kFullShare = 1.02;
constexpr int kNewtonSteps = 20;
constexpr int kHalvings = 40;
// Of the thrust ahead, at least, with which a path leads on: a hull that is hardly pushed has a
// heading that its path does not decide.
constexpr double kOnwardShare = 0.35;

// `value` that changes with time by `rate`.
auto changing(double value, double rate) {
  return dual::chain(value, rate, variable<0>(0.0));
}

// A hull that is pushed, in its own frame: velocity and acceleration, and those of the earth's
// frame seen from it.
struct Pushed {
  Vector2d e, n;
  double u, v;
  Body<double, double, double> rate;
  double ahead, port;

  Pushed(const ManoeuvringModel& model, const Mobility<double>& mobility,
         const Disturbance& disturbance, double psi_rad, double r, double surge_n,
         const Vector2d& velocity)
      : e(unitVector(psi_rad)),
        n(across(e)),
        u(e.dot(velocity)),
        v(n.dot(velocity)),
        rate(bodyAcceleration(
            model, mobility, e.x(), e.y(), outsideForce(e.x(), e.y(), model, disturbance),
            disturbance.current_mps.x(), disturbance.current_mps.y(), u, v, r, surge_n, 0.0)),
        ahead(rate.surge - r * v),
        port(rate.sway + r * u) {}
  [[nodiscard]] Vector2d acceleration() const { return ahead * e + port * n; }
};

}  // namespace

bool paperHolds(const Parameters& vessel) {
  const PaperModel& p = vessel.paper;
  const ManoeuvringModel& m = vessel.manoeuvring;
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); };
  const bool couples =
      m.munk_kg != 0.0 || m.sway_from_yaw_kgmps != 0.0 || m.yaw_from_sway_kgmps != 0.0;
  return !couples && same(m.surge_inertia_kg, p.m1_kg) && same(m.sway_inertia_kg, p.m1_kg) &&
         same(m.yaw_inertia_kgm2, p.m2_kgm2);
}

Vector2d pushed(const ManoeuvringModel& model, const Disturbance& disturbance, double psi_rad,
                double yaw_rate_radps, double surge_n, const Vector2d& velocity) {
  return Pushed(model, Mobility(model), disturbance, psi_rad, yaw_rate_radps, surge_n, velocity)
      .acceleration();
}

void push(const ManoeuvringModel& model, const Disturbance& disturbance, const Swing& swing,
          double surge_n, double surge_rate_nps, FlatPoint& motion) {
  const Mobility mobility(model);
  const double r = swing.yaw_rate_radps;
  const double r1 = swing.yaw_acceleration;
  const Vector2d& current = disturbance.current_mps;
  const Pushed now(model, mobility, disturbance, swing.psi_rad, r, surge_n, motion.velocity);
  motion.acceleration = now.acceleration();
  const auto cosine = changing(now.e.x(), -r * now.e.y());
  const auto sine = changing(now.e.y(), r * now.e.x());
  const auto later = bodyAcceleration(
      model, mobility, cosine, sine, outsideForce(cosine, sine, model, disturbance), current.x(),
      current.y(), changing(now.u, now.rate.surge), changing(now.v, now.rate.sway), changing(r, r1),
      changing(surge_n, surge_rate_nps), changing(0.0, 0.0));
  const double ahead_rate = slope<0>(later.surge) - r1 * now.v - r * now.rate.sway;
  const double port_rate = slope<0>(later.sway) + r1 * now.u + r * now.rate.surge;
  motion.jerk = (ahead_rate - r * now.port) * now.e + (port_rate + r * now.ahead) * now.n;
}

FlatPoint pathFromState(const State& state, double force_max_n, const Parameters& vessel,
                        const Disturbance& disturbance) {
  if (paperHolds(vessel)) {
    return InverseDynamics(vessel, disturbance)
        .fromState(state, 2.0 * kOnwardShare * vessel.thrusters.ahead_max_n, force_max_n);
  }
  const double psi = state[kPsi];
  FlatPoint z;
  z.position = state.head<2>();
  z.velocity = velocityOverGround(state);
  const ManoeuvringModel& m = vessel.manoeuvring;
  const Thrusters& t = vessel.thrusters;
  const double r = state[kYawRate];
  const Tau steady = demandOf(m, disturbance, psi, r, 0.0, z.velocity, Vector2d::Zero()).tau;
  // What the moment that keeps the yaw rate leaves of the surge force; a hull that slides broadside
  // may be turned by more than there is, and goes on turning.
  const double astern_max_n = force_max_n * t.astern_max_n / t.ahead_max_n;
  const double most_turning_n = 0.5 * (force_max_n - astern_max_n);
  const double left_n =
      std::max(force_max_n - std::abs(steady.yaw_nm) / t.lever_arm_m, most_turning_n);
  const double surge_n = std::min(std::max(steady.surge_n, 2.0 * kOnwardShare * t.ahead_max_n),
                                  std::min(force_max_n, left_n));
  const double most_nm = t.lever_arm_m * std::min(force_max_n - surge_n, astern_max_n + surge_n);
  const double yaw_nm = std::clamp(steady.yaw_nm, -most_nm, most_nm);
  push(m, disturbance, {psi, r, (yaw_nm - steady.yaw_nm) / m.yaw_inertia_kgm2}, surge_n, 0.0, z);
  return z;
}

double TurnLaw::timeTo(double angle_rad) const {
  // Turned by t: r_full (t - lag (1 - exp(-t / lag))), convex. From beyond, where the rate is
  // r_full all the while but for one lag, Newton's steps come down to it.
  double time_s = angle_rad / r_full + lag_s;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double up = 1.0 - std::exp(-time_s / lag_s);
    time_s -= (time_s - lag_s * up - angle_rad / r_full) / up;
  }
  return time_s;
}

TurnLaw turnLaw(const Parameters& vessel, double moment_nm) {
  if (paperHolds(vessel)) {
    const double drag = vessel.paper.d3_kgm2ps;
    return {vessel.paper.m2_kgm2 / drag, moment_nm / drag};
  }
  // At the top rate Nrr r^2 + Nr r = M. Below it, with k = I / lag and r_full a little over the
  // rate c that is reached, the way up asks for no more than M if k c does not; the way back for
  //   k r_full + max over r <= c of (k - Nr) r - Nrr r^2,
  // which k makes just M.
  const double nr = vessel.manoeuvring.yaw_drag_kgm2ps;
  const double nrr = vessel.manoeuvring.yaw_drag_quadratic_kgm2;
  const double top = moment_nm / steadyDrag(nr, nrr, moment_nm);
  const double reached = kReachedShare * top;
  const double r_full = kFullShare * reached;
  const auto back = [&](double k) {
    const double hardest = std::min(std::max(k - nr, 0.0) / (2.0 * nrr + 1e-12), reached);
    return k * r_full + (k - nr) * hardest - nrr * hardest * hardest;
  };
  double low = 0.0;
  double high = moment_nm / r_full;
  for (int i = 0; i < kHalvings; ++i) {
    const double k = 0.5 * (low + high);
    (back(k) < moment_nm ? low : high) = k;
  }
  return {vessel.manoeuvring.yaw_inertia_kgm2 / low, r_full};
}

}  // namespace otter_nav::vessel
