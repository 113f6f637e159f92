#include "encounter/helmsman.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/steady_motion.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::encounter {
namespace {

// Of the thrusters' limits; the rest is the tracker's, for waves.
constexpr double kHelmThrustShare = 0.9;
constexpr double kSpeedShare = 0.95;    // of the speed limit, likewise
constexpr double kHelmTurnShare = 0.8;  // of the steadiest turn on the spot
constexpr double kTurnMostRadps = 1.3;
// In which he has speed and rate of turn as told, if the thrusters give that.
constexpr double kSpeedS = 0.4;
constexpr double kTurnSettleS = 0.3;
constexpr double kThrustS = 0.15;  // thrust follows orders no quicker, so that nothing jumps

}  // namespace

Helmsman::Helmsman(const vessel::Parameters& vessel, const vessel::Disturbance& disturbance,
                   double speed_max_mps)
    : model_(vessel.manoeuvring),
      mobility_(vessel.manoeuvring),
      thrusters_(vessel.thrusters),
      disturbance_(disturbance) {
  thrusters_.ahead_max_n *= kHelmThrustShare;
  thrusters_.astern_max_n *= kHelmThrustShare;
  const auto steady = [](double linear, double quadratic, double force) {
    return force / vessel::steadyDrag(linear, quadratic, force);
  };
  const double top = steady(model_.surge_drag_kgps, model_.surge_drag_quadratic_kgpm,
                            2.0 * thrusters_.ahead_max_n);
  speed_most_mps_ = std::min(kSpeedShare * speed_max_mps, top);
  turn_most_radps_ =
      std::min(kTurnMostRadps,
               kHelmTurnShare * steady(model_.yaw_drag_kgm2ps, model_.yaw_drag_quadratic_kgm2,
                                       vessel::greatestMoment(thrusters_)));
  speed_lag_s_ =
      model_.surge_inertia_kg * speed_most_mps_ / std::max(1e-6, 2.0 * thrusters_.ahead_max_n);
}

// Turning first: what the thrusters have left makes way.
vessel::Tau Helmsman::order(const Hull& hull, const Helm& helm, double cosine, double sine) const {
  const auto outside = vessel::outsideForce(cosine, sine, model_, disturbance_);
  const auto steady = vessel::waterForce(model_, helm.surge_mps, 0.0, 0.0);
  const auto water = vessel::waterForce(model_, hull.surge_mps, hull.sway_mps, hull.yaw_rate_radps);
  const double arm = thrusters_.lever_arm_m;
  const double most = vessel::greatestMoment(thrusters_);
  vessel::Tau tau;
  tau.yaw_nm =
      std::clamp(model_.yaw_inertia_kgm2 * (helm.turn_radps - hull.yaw_rate_radps) / kTurnSettleS -
                     water.yaw - outside.yaw,
                 -most, most);
  const double taken = std::abs(tau.yaw_nm) / arm;
  tau.surge_n =
      std::clamp(model_.surge_inertia_kg * (helm.surge_mps - hull.surge_mps) / kSpeedS -
                     steady.surge - outside.surge,
                 taken - 2.0 * thrusters_.astern_max_n, 2.0 * thrusters_.ahead_max_n - taken);
  return tau;
}

void Helmsman::step(Hull& hull, const Helm& helm, double dt_s) const {
  const double cosine = hull.ahead.x();
  const double sine = hull.ahead.y();
  const vessel::Tau wanted = order(hull, helm, cosine, sine);
  const double share = dt_s / (kThrustS + dt_s);
  hull.tau.surge_n += share * (wanted.surge_n - hull.tau.surge_n);
  hull.tau.yaw_nm += share * (wanted.yaw_nm - hull.tau.yaw_nm);
  const auto outside = vessel::outsideForce(cosine, sine, model_, disturbance_);
  const auto rate = vessel::bodyAcceleration(
      model_, mobility_, cosine, sine, outside, disturbance_.current_mps.x(),
      disturbance_.current_mps.y(), hull.surge_mps, hull.sway_mps, hull.yaw_rate_radps,
      hull.tau.surge_n, hull.tau.yaw_nm);
  const Eigen::Vector2d before(cosine * hull.surge_mps - sine * hull.sway_mps,
                               sine * hull.surge_mps + cosine * hull.sway_mps);
  const double yaw_before = hull.yaw_rate_radps;
  // The velocity over ground changes by the force alone; the axes turn under it.
  hull.yaw_rate_radps += dt_s * rate.yaw;
  const double turn = 0.5 * dt_s * (yaw_before + hull.yaw_rate_radps);
  const double u = hull.surge_mps + dt_s * (rate.surge - yaw_before * hull.sway_mps);
  const double v = hull.sway_mps + dt_s * (rate.sway + yaw_before * hull.surge_mps);
  hull.psi_rad += turn;
  // Of a small angle.
  const double turn2 = turn * turn;
  const double c = 1.0 - turn2 * (0.5 - turn2 / 24.0);
  const double s = turn * (1.0 - turn2 * (1.0 / 6.0 - turn2 / 120.0));
  hull.ahead = {c * hull.ahead.x() - s * hull.ahead.y(), s * hull.ahead.x() + c * hull.ahead.y()};
  hull.surge_mps = c * u + s * v;
  hull.sway_mps = c * v - s * u;
  hull.position += 0.5 * dt_s * (before + hull.velocity());
}

Helmsman::Acceleration Helmsman::acceleration(const Hull& hull) const {
  const double cosine = hull.ahead.x();
  const double sine = hull.ahead.y();
  const auto outside = vessel::outsideForce(cosine, sine, model_, disturbance_);
  const auto rate = vessel::bodyAcceleration(
      model_, mobility_, cosine, sine, outside, disturbance_.current_mps.x(),
      disturbance_.current_mps.y(), hull.surge_mps, hull.sway_mps, hull.yaw_rate_radps,
      hull.tau.surge_n, hull.tau.yaw_nm);
  const Eigen::Vector2d in_body(rate.surge - hull.yaw_rate_radps * hull.sway_mps,
                                rate.sway + hull.yaw_rate_radps * hull.surge_mps);
  return {in_body.x() * hull.ahead + in_body.y() * across(hull.ahead), rate.yaw};
}

}  // namespace otter_nav::encounter
