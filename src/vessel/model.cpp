#include "otter_nav/vessel/model.hpp"

#include <cmath>

#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::vessel {
namespace {

// The state seen from the water: rotation, relative velocities and body-frame force.
struct WaterFrame {
  double cos_psi;
  double sin_psi;
  double current_surge;
  double current_sway;
  double surge;  // through the water
  double sway;
  OutsideLoad load;
};

WaterFrame waterFrame(const State& x, const Disturbance& d, const ManoeuvringModel& m) {
  WaterFrame w{};
  w.cos_psi = std::cos(x[kPsi]);
  w.sin_psi = std::sin(x[kPsi]);
  w.current_surge = w.cos_psi * d.current_mps.x() + w.sin_psi * d.current_mps.y();
  w.current_sway = -w.sin_psi * d.current_mps.x() + w.cos_psi * d.current_mps.y();
  w.surge = x[kSurge] - w.current_surge;
  w.sway = x[kSway] - w.current_sway;
  w.load = outsideLoad(x[kPsi], m, d);
  return w;
}

// M nu_r' = ..., plus the rate of the current seen from the turning body:
// u_c' = r v_c, v_c' = -r u_c for a current steady in the earth frame.
State derivativeIn(const WaterFrame& w, const State& x, const Tau& tau, const ManoeuvringModel& m) {
  const double r = x[kYawRate];
  State dx;
  dx[kX] = w.cos_psi * x[kSurge] - w.sin_psi * x[kSway];
  dx[kY] = w.sin_psi * x[kSurge] + w.cos_psi * x[kSway];
  dx[kPsi] = r;
  dx[kSurge] = (m.surge_centripetal_kg * w.sway * r + tau.surge_n + w.load.surge_n -
                (m.surge_drag_kgps + m.surge_drag_quadratic_kgpm * std::abs(w.surge)) * w.surge) /
                   m.surge_inertia_kg +
               r * w.current_sway;
  dx[kSway] = (-m.sway_centripetal_kg * w.surge * r + w.load.sway_n -
               (m.sway_drag_kgps + m.sway_drag_quadratic_kgpm * std::abs(w.sway)) * w.sway -
               m.sway_from_yaw_kgmps * r) /
                  m.sway_inertia_kg -
              r * w.current_surge;
  dx[kYawRate] = (tau.yaw_nm + w.load.yaw_nm -
                  (m.yaw_drag_kgm2ps + m.yaw_drag_quadratic_kgm2 * std::abs(r)) * r -
                  m.munk_kg * w.surge * w.sway - m.yaw_from_sway_kgmps * w.sway) /
                 m.yaw_inertia_kgm2;
  return dx;
}

// Columns of the heading, the body velocities and the yaw rate.
StateJacobian stateJacobian(const WaterFrame& w, const State& x, const ManoeuvringModel& m) {
  const double r = x[kYawRate];
  const double surge_slope =
      -(m.surge_drag_kgps + 2.0 * m.surge_drag_quadratic_kgpm * std::abs(w.surge)) /
      m.surge_inertia_kg;
  const double sway_slope =
      -(m.sway_drag_kgps + 2.0 * m.sway_drag_quadratic_kgpm * std::abs(w.sway)) / m.sway_inertia_kg;
  const double surge_from_sway = m.surge_centripetal_kg * r / m.surge_inertia_kg;
  const double sway_from_surge = -m.sway_centripetal_kg * r / m.sway_inertia_kg;
  const double yaw_from_surge = -m.munk_kg * w.sway / m.yaw_inertia_kgm2;
  const double yaw_from_sway = -(m.munk_kg * w.surge + m.yaw_from_sway_kgmps) / m.yaw_inertia_kgm2;

  StateJacobian a = StateJacobian::Zero();
  a(kX, kPsi) = -w.sin_psi * x[kSurge] - w.cos_psi * x[kSway];
  a(kX, kSurge) = w.cos_psi;
  a(kX, kSway) = -w.sin_psi;
  a(kY, kPsi) = w.cos_psi * x[kSurge] - w.sin_psi * x[kSway];
  a(kY, kSurge) = w.sin_psi;
  a(kY, kSway) = w.cos_psi;
  a(kPsi, kYawRate) = 1.0;

  a(kSurge, kSurge) = surge_slope;
  a(kSurge, kSway) = surge_from_sway;
  a(kSurge, kYawRate) = m.surge_centripetal_kg * w.sway / m.surge_inertia_kg + w.current_sway;
  a(kSway, kSurge) = sway_from_surge;
  a(kSway, kSway) = sway_slope;
  a(kSway, kYawRate) =
      -(m.sway_centripetal_kg * w.surge + m.sway_from_yaw_kgmps) / m.sway_inertia_kg -
      w.current_surge;
  a(kYawRate, kSurge) = yaw_from_surge;
  a(kYawRate, kSway) = yaw_from_sway;
  a(kYawRate, kYawRate) =
      -(m.yaw_drag_kgm2ps + 2.0 * m.yaw_drag_quadratic_kgm2 * std::abs(r)) / m.yaw_inertia_kgm2;

  // Turning the hull turns current and force in the body frame: u_c, v_c rotate as
  // d u_c / d psi = v_c, d v_c / d psi = -u_c, so u_r and v_r change by -v_c and u_c.
  const double cu = w.current_surge;
  const double cv = w.current_sway;
  a(kSurge, kPsi) =
      surge_slope * -cv + surge_from_sway * cu + w.load.surge_slope_n / m.surge_inertia_kg - r * cu;
  a(kSway, kPsi) =
      sway_from_surge * -cv + sway_slope * cu + w.load.sway_slope_n / m.sway_inertia_kg - r * cv;
  a(kYawRate, kPsi) =
      yaw_from_surge * -cv + yaw_from_sway * cu + w.load.yaw_slope_nm / m.yaw_inertia_kgm2;
  return a;
}

}  // namespace

OutsideLoad outsideLoad(double psi_rad, const ManoeuvringModel& model,
                        const Disturbance& disturbance) {
  const double c = std::cos(psi_rad);
  const double s = std::sin(psi_rad);
  const Eigen::Vector2d& force = disturbance.force_n;
  const Eigen::Vector2d& wind = disturbance.wind_mps;
  OutsideLoad load;
  load.surge_n = c * force.x() + s * force.y();
  load.sway_n = -s * force.x() + c * force.y();
  load.yaw_nm = disturbance.moment_nm;
  load.surge_slope_n = load.sway_n;
  load.sway_slope_n = -load.surge_n;
  // Turning the hull turns the wind in the body frame: wx' = wy, wy' = -wx.
  const double wx = c * wind.x() + s * wind.y();
  const double wy = -s * wind.x() + c * wind.y();
  load.surge_n += model.wind_surge_kgpm * std::abs(wx) * wx;
  load.sway_n += model.wind_sway_kgpm * std::abs(wy) * wy;
  load.yaw_nm += model.wind_yaw_kg * wx * wy;
  load.surge_slope_n += 2.0 * model.wind_surge_kgpm * std::abs(wx) * wy;
  load.sway_slope_n -= 2.0 * model.wind_sway_kgpm * std::abs(wy) * wx;
  load.yaw_slope_nm = model.wind_yaw_kg * (wy * wy - wx * wx);
  return load;
}

State stateDerivative(const State& state, const Thrusts& thrusts, const ManoeuvringModel& model,
                      const Thrusters& thrusters, const Disturbance& disturbance) {
  return derivativeIn(waterFrame(state, disturbance, model), state,
                      tauFromThrusts(thrusts, thrusters), model);
}

Linearization linearize(const State& state, const Thrusts& thrusts, const ManoeuvringModel& model,
                        const Thrusters& thrusters, const Disturbance& disturbance) {
  const WaterFrame w = waterFrame(state, disturbance, model);
  Linearization l;
  l.derivative = derivativeIn(w, state, tauFromThrusts(thrusts, thrusters), model);
  l.state_jacobian = stateJacobian(w, state, model);
  l.input_jacobian.setZero();
  l.input_jacobian.row(kSurge).setConstant(1.0 / model.surge_inertia_kg);
  l.input_jacobian(kYawRate, kLeft) = -thrusters.lever_arm_m / model.yaw_inertia_kgm2;
  l.input_jacobian(kYawRate, kRight) = thrusters.lever_arm_m / model.yaw_inertia_kgm2;
  return l;
}

}  // namespace otter_nav::vessel
