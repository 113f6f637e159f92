#include "otter_nav/identification/sensitivity.hpp"

#include <cmath>

#include "otter_nav/base/rk4.hpp"

namespace otter_nav::identification {

using vessel::kPsi;
using vessel::kStateSize;
using vessel::kSurge;
using vessel::kSway;
using vessel::kYawRate;
using vessel::State;

namespace {

vessel::Disturbance constantDisturbance(const Model& model) {
  vessel::Disturbance disturbance;
  disturbance.current_mps = model.current_mps;
  return disturbance;
}

// State and sensitivity rates together.
struct Rates {
  State state;
  Sensitivity sensitivity;
};

void rates(const Model& model, const CoefficientMap& map, bool with_current,
           const vessel::Thrusts& thrusts, const State& state, const Sensitivity& sensitivity,
           Rates& out) {
  const vessel::Linearization l = vessel::linearize(state, thrusts, model.coefficients,
                                                    model.thrusters, constantDisturbance(model));
  out.state = l.derivative;
  // Nothing depends on the position, and the heading's rate is the yaw rate: only these columns.
  out.sensitivity.resize(kStateSize, sensitivity.cols());
  out.sensitivity.noalias() =
      l.state_jacobian.rightCols<4>().lazyProduct(sensitivity.bottomRows<4>());
  const Eigen::Index parameters = map.cols();
  out.sensitivity.bottomLeftCorner(3, parameters).noalias() +=
      coefficientJacobian(state, l.derivative, model).lazyProduct(map);
  if (with_current) {
    out.sensitivity.block(3, parameters, 3, 2) += currentJacobian(state, l.state_jacobian);
  }
}

}  // namespace

CoefficientJacobian coefficientJacobian(const State& state, const State& derivative,
                                        const Model& model) {
  const vessel::ManoeuvringModel& m = model.coefficients;
  const double c = std::cos(state[kPsi]);
  const double s = std::sin(state[kPsi]);
  const double current_surge = c * model.current_mps.x() + s * model.current_mps.y();
  const double current_sway = -s * model.current_mps.x() + c * model.current_mps.y();
  const double u = state[kSurge] - current_surge;
  const double v = state[kSway] - current_sway;
  const double r = state[kYawRate];
  const double per_surge = 1.0 / m.surge_inertia_kg;
  const double per_sway = 1.0 / m.sway_inertia_kg;
  const double per_yaw = 1.0 / m.yaw_inertia_kgm2;

  CoefficientJacobian j = CoefficientJacobian::Zero();
  // Inertias divide the forces: what is left of the rate without the turning of the current.
  j(0, kSurgeInertia) = -(derivative[kSurge] - r * current_sway) * per_surge;
  j(1, kSwayInertia) = -(derivative[kSway] + r * current_surge) * per_sway;
  j(2, kYawInertia) = -derivative[kYawRate] * per_yaw;
  j(0, kSurgeCentripetal) = v * r * per_surge;
  j(0, kSurgeDrag) = -u * per_surge;
  j(0, kSurgeDragQuadratic) = -std::abs(u) * u * per_surge;
  j(1, kSwayCentripetal) = -u * r * per_sway;
  j(1, kSwayDrag) = -v * per_sway;
  j(1, kSwayDragQuadratic) = -std::abs(v) * v * per_sway;
  j(1, kSwayFromYaw) = -r * per_sway;
  j(2, kMunk) = -u * v * per_yaw;
  j(2, kYawDrag) = -r * per_yaw;
  j(2, kYawDragQuadratic) = -std::abs(r) * r * per_yaw;
  j(2, kYawFromSway) = -v * per_yaw;
  return j;
}

Eigen::Matrix<double, 3, 2> currentJacobian(const State& state,
                                            const vessel::StateJacobian& jacobian) {
  // Velocities through the water fall as the current's body components rise; the current itself
  // turns in the body frame: u_c' = r v_c, v_c' = -r u_c.
  Eigen::Matrix<double, 3, 2> by_body = -jacobian.block<3, 2>(kSurge, kSurge);
  by_body(0, 1) += state[kYawRate];
  by_body(1, 0) -= state[kYawRate];
  Eigen::Matrix2d body_from_earth;
  body_from_earth << std::cos(state[kPsi]), std::sin(state[kPsi]), -std::sin(state[kPsi]),
      std::cos(state[kPsi]);
  return by_body * body_from_earth;
}

void stepWithSensitivity(const Model& model, const CoefficientMap& map, bool with_current,
                         const vessel::Thrusts& thrusts, double dt, State& state,
                         Sensitivity& sensitivity) {
  Rates k1;
  Rates k2;
  Rates k3;
  Rates k4;
  rates(model, map, with_current, thrusts, state, sensitivity, k1);
  rates(model, map, with_current, thrusts, state + 0.5 * dt * k1.state,
        sensitivity + 0.5 * dt * k1.sensitivity, k2);
  rates(model, map, with_current, thrusts, state + 0.5 * dt * k2.state,
        sensitivity + 0.5 * dt * k2.sensitivity, k3);
  rates(model, map, with_current, thrusts, state + dt * k3.state, sensitivity + dt * k3.sensitivity,
        k4);
  state += dt / 6.0 * (k1.state + 2.0 * k2.state + 2.0 * k3.state + k4.state);
  sensitivity +=
      dt / 6.0 * (k1.sensitivity + 2.0 * k2.sensitivity + 2.0 * k3.sensitivity + k4.sensitivity);
}

State step(const Model& model, const vessel::Thrusts& thrusts, double dt, const State& state) {
  const vessel::Disturbance disturbance = constantDisturbance(model);
  return rk4Step(
      [&](double /*t*/, const State& x) {
        return vessel::stateDerivative(x, thrusts, model.coefficients, model.thrusters,
                                       disturbance);
      },
      0.0, state, dt);
}

}  // namespace otter_nav::identification
