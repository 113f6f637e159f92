#include "otter_nav/vessel/model.hpp"

#include <cmath>

#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::vessel {
namespace {

// Places the law's numbers in a State; the same for values and slopes.
template <typename Position, typename Acceleration>
State stateOf(const Position& position, double r, const Acceleration& acceleration) {
  State dx;
  dx << position.x, position.y, r, acceleration.surge, acceleration.sway, acceleration.yaw;
  return dx;
}

template <int Direction, typename Position, typename Acceleration>
void setColumn(const Position& position, const Acceleration& acceleration, int column,
               StateJacobian& jacobian) {
  jacobian.col(column) =
      stateOf(Plane<double>{slope<Direction>(position.x), slope<Direction>(position.y)}, 0.0,
              Body{slope<Direction>(acceleration.surge), slope<Direction>(acceleration.sway),
                   slope<Direction>(acceleration.yaw)});
}

}  // namespace

OutsideLoad outsideLoad(double psi_rad, const ManoeuvringModel& model,
                        const Disturbance& disturbance) {
  const Turned<0, double> psi(std::cos(psi_rad), std::sin(psi_rad));
  const auto force = outsideForce(psi.cosine, psi.sine, model, disturbance);
  return {valueOf(force.surge),  valueOf(force.sway),  valueOf(force.yaw),
          slope<0>(force.surge), slope<0>(force.sway), slope<0>(force.yaw)};
}

State stateDerivative(const State& x, const Thrusts& thrusts, const ManoeuvringModel& model,
                      const Thrusters& thrusters, const Disturbance& disturbance) {
  const Tau tau = tauFromThrusts(thrusts, thrusters);
  const double c = std::cos(x[kPsi]);
  const double s = std::sin(x[kPsi]);
  const Eigen::Vector2d& current = disturbance.current_mps;
  return stateOf(positionRate(c, s, x[kSurge], x[kSway]), x[kYawRate],
                 bodyAcceleration(model, Mobility(model), outsideForce(c, s, model, disturbance),
                                  aheadPart(c, s, current.x(), current.y()),
                                  portPart(c, s, current.x(), current.y()), x[kSurge], x[kSway],
                                  x[kYawRate], tau.surge_n, tau.yaw_nm));
}

Linearization linearize(const State& x, const Thrusts& thrusts, const ManoeuvringModel& model,
                        const Thrusters& thrusters, const Disturbance& disturbance) {
  const Tau tau = tauFromThrusts(thrusts, thrusters);
  const Turned<kPsi, double> psi(std::cos(x[kPsi]), std::sin(x[kPsi]));
  const auto u = variable<kSurge>(x[kSurge]);
  const auto v = variable<kSway>(x[kSway]);
  const auto r = variable<kYawRate>(x[kYawRate]);
  const Eigen::Vector2d& current = disturbance.current_mps;
  const Mobility mobility(model);
  const auto position = positionRate(psi.cosine, psi.sine, u, v);
  const auto acceleration = bodyAcceleration(
      model, mobility, outsideForce(psi.cosine, psi.sine, model, disturbance),
      aheadPart(psi.cosine, psi.sine, current.x(), current.y()),
      portPart(psi.cosine, psi.sine, current.x(), current.y()), u, v, r, tau.surge_n, tau.yaw_nm);
  Linearization l;
  l.derivative =
      stateOf(Plane<double>{position.x.value, position.y.value}, x[kYawRate],
              Body{acceleration.surge.value, acceleration.sway.value, acceleration.yaw.value});
  l.state_jacobian.setZero();
  setColumn<kPsi>(position, acceleration, kPsi, l.state_jacobian);
  setColumn<kSurge>(position, acceleration, kSurge, l.state_jacobian);
  setColumn<kSway>(position, acceleration, kSway, l.state_jacobian);
  setColumn<kYawRate>(position, acceleration, kYawRate, l.state_jacobian);
  l.state_jacobian(kPsi, kYawRate) = 1.0;
  l.input_jacobian.setZero();
  l.input_jacobian.row(kSurge).setConstant(mobility.surge);
  l.input_jacobian(kYawRate, kLeft) = -thrusters.lever_arm_m * mobility.yaw;
  l.input_jacobian(kYawRate, kRight) = thrusters.lever_arm_m * mobility.yaw;
  return l;
}

}  // namespace otter_nav::vessel
