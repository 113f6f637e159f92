#include "otter_nav/vessel/model.hpp"

#include <cmath>

#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::vessel {
namespace {

template <typename Position, typename Acceleration>
State stateOf(const Position& position, double r, const Acceleration& acceleration) {
  State dx;
  dx << valueOf(position.x), valueOf(position.y), r, valueOf(acceleration.surge),
      valueOf(acceleration.sway), valueOf(acceleration.yaw);
  return dx;
}

// Directions beside the state's own.
enum CurrentDirection : int { kByCurrentX = kStateSize, kByCurrentY };

template <int Direction, typename Acceleration>
Eigen::Vector3d slopes(const Acceleration& a) {
  return {slope<Direction>(a.surge), slope<Direction>(a.sway), slope<Direction>(a.yaw)};
}
template <int Direction, typename Position, typename Acceleration>
State column(const Position& position, const Acceleration& acceleration) {
  State by;
  by << slope<Direction>(position.x), slope<Direction>(position.y), 0.0,
      slopes<Direction>(acceleration);
  return by;
}

}  // namespace

OutsideLoad outsideLoad(double psi_rad, const ManoeuvringModel& model,
                        const Disturbance& disturbance) {
  const auto force = outsideForce(std::cos(psi_rad), std::sin(psi_rad), model, disturbance);
  return {force.surge, force.sway, force.yaw};
}

State stateDerivative(const State& x, const Thrusts& thrusts, const ManoeuvringModel& model,
                      const Thrusters& thrusters, const Disturbance& disturbance) {
  const Tau tau = tauFromThrusts(thrusts, thrusters);
  const double c = std::cos(x[kPsi]);
  const double s = std::sin(x[kPsi]);
  const Eigen::Vector2d& current = disturbance.current_mps;
  return stateOf(positionRate(c, s, x[kSurge], x[kSway]), x[kYawRate],
                 bodyAcceleration(model, Mobility(model), c, s,
                                  outsideForce(c, s, model, disturbance), current.x(), current.y(),
                                  x[kSurge], x[kSway], x[kYawRate], tau.surge_n, tau.yaw_nm));
}

Linearization linearize(const State& x, const Thrusts& thrusts, const ManoeuvringModel& model,
                        const Thrusters& thrusters, const Disturbance& disturbance) {
  const Tau tau = tauFromThrusts(thrusts, thrusters);
  const Turned<kPsi, double> psi(std::cos(x[kPsi]), std::sin(x[kPsi]));
  const auto u = variable<kSurge>(x[kSurge]);
  const auto v = variable<kSway>(x[kSway]);
  const auto r = variable<kYawRate>(x[kYawRate]);
  const auto current_x = variable<kByCurrentX>(disturbance.current_mps.x());
  const auto current_y = variable<kByCurrentY>(disturbance.current_mps.y());
  const Mobility mobility(model);
  const auto position = positionRate(psi.cosine, psi.sine, u, v);
  const auto acceleration = bodyAcceleration(
      model, mobility, psi.cosine, psi.sine, outsideForce(psi.cosine, psi.sine, model, disturbance),
      current_x, current_y, u, v, r, tau.surge_n, tau.yaw_nm);
  Linearization l;
  l.derivative = stateOf(position, x[kYawRate], acceleration);
  l.state_jacobian.setZero();
  l.state_jacobian.col(kPsi) = column<kPsi>(position, acceleration);
  l.state_jacobian.col(kSurge) = column<kSurge>(position, acceleration);
  l.state_jacobian.col(kSway) = column<kSway>(position, acceleration);
  l.state_jacobian.col(kYawRate) = column<kYawRate>(position, acceleration);
  l.state_jacobian(kPsi, kYawRate) = 1.0;
  l.input_jacobian.setZero();
  l.input_jacobian.row(kSurge).setConstant(mobility.surge);
  l.input_jacobian(kYawRate, kLeft) = -thrusters.lever_arm_m * mobility.yaw;
  l.input_jacobian(kYawRate, kRight) = thrusters.lever_arm_m * mobility.yaw;
  l.current_jacobian << slopes<kByCurrentX>(acceleration), slopes<kByCurrentY>(acceleration);
  return l;
}

}  // namespace otter_nav::vessel
