#include "sensitivity.hpp"

#include <cmath>
#include <utility>

#include "otter_nav/base/dual.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::identification {

using vessel::kPsi;
using vessel::kStateSize;
using vessel::kSurge;
using vessel::kSway;
using vessel::kYawRate;
using vessel::State;

namespace {

// Directions of the rates' derivatives: the coefficients', then these.
enum Direction : int { kByPsi = kCoefficientCount, kByU, kByV, kByR, kByCurrentX, kByCurrentY };
constexpr int kDirections = kByCurrentY + 1;
using Coefficient = Dual<double, (Directions{1} << kCoefficientCount) - 1U>;
using SeededModel = vessel::BasicManoeuvringModel<Coefficient>;

SeededModel seeded(vessel::ManoeuvringModel model) {
  const Coefficients values = coefficientsOf(model);
  SeededModel result;
  int i = 0;
  forEachCoefficient(result, [&](const char*, Coefficient& c, const config::Range&) {
    c = Coefficient(values[i]);
    c.slopes[i++] = 1.0;
  });
  return result;
}

// A step's model: its coefficients as variables, and the derived numbers.
struct Law {
  const Model& model;
  SeededModel coefficients;
  vessel::Mobility<Coefficient> mobility;
  explicit Law(const Model& m)
      : model(m), coefficients(seeded(m.coefficients)), mobility(coefficients) {}
};

// State and sensitivity rates together.
struct Rates {
  State state;
  Sensitivity sensitivity;
};

using RateJacobian = Eigen::Matrix<double, kStateSize, kDirections>;

template <typename Value, Directions Set, std::size_t... D>
void setRow(const Dual<Value, Set>& rate, int row, RateJacobian& j, std::index_sequence<D...>) {
  ((j(row, static_cast<int>(D)) = slope<static_cast<int>(D)>(rate)), ...);
}

// x' with its derivatives by coefficients, heading, body velocities and current.
RateJacobian rateJacobian(const Law& law, const vessel::Tau& tau, const State& x, State& rate) {
  const vessel::Turned<kByPsi, double> psi(std::cos(x[kPsi]), std::sin(x[kPsi]));
  const auto u = variable<kByU>(x[kSurge]);
  const auto v = variable<kByV>(x[kSway]);
  const auto r = variable<kByR>(x[kYawRate]);
  const auto current_x = variable<kByCurrentX>(law.model.current_mps.x());
  const auto current_y = variable<kByCurrentY>(law.model.current_mps.y());
  const auto position = vessel::positionRate(psi.cosine, psi.sine, u, v);
  const auto acceleration =
      vessel::bodyAcceleration(law.coefficients, law.mobility, vessel::Body{0.0, 0.0, 0.0},
                               vessel::aheadPart(psi.cosine, psi.sine, current_x, current_y),
                               vessel::portPart(psi.cosine, psi.sine, current_x, current_y), u, v,
                               r, tau.surge_n, tau.yaw_nm);
  rate << position.x.value, position.y.value, x[kYawRate], acceleration.surge.value,
      acceleration.sway.value, acceleration.yaw.value;
  RateJacobian j;
  constexpr std::make_index_sequence<kDirections> kAll;
  setRow(position.x, vessel::kX, j, kAll);
  setRow(position.y, vessel::kY, j, kAll);
  setRow(r, kPsi, j, kAll);
  setRow(acceleration.surge, kSurge, j, kAll);
  setRow(acceleration.sway, kSway, j, kAll);
  setRow(acceleration.yaw, kYawRate, j, kAll);
  return j;
}

void rates(const Law& law, const CoefficientMap& map, bool with_current, const vessel::Tau& tau,
           const State& state, const Sensitivity& sensitivity, Rates& out) {
  const RateJacobian j = rateJacobian(law, tau, state, out.state);
  // Nothing depends on the position: only the columns from the heading on.
  out.sensitivity.resize(kStateSize, sensitivity.cols());
  out.sensitivity.noalias() = j.middleCols<4>(kByPsi).lazyProduct(sensitivity.bottomRows<4>());
  const Eigen::Index parameters = map.cols();
  out.sensitivity.bottomLeftCorner(3, parameters).noalias() +=
      j.bottomLeftCorner<3, kCoefficientCount>().lazyProduct(map);
  if (with_current) {
    out.sensitivity.block(3, parameters, 3, 2) += j.bottomRightCorner<3, 2>();
  }
}

}  // namespace

void stepWithSensitivity(const Model& model, const CoefficientMap& map, bool with_current,
                         const vessel::Thrusts& thrusts, double dt, State& state,
                         Sensitivity& sensitivity) {
  const Law law(model);
  const vessel::Tau tau = vessel::tauFromThrusts(thrusts, model.thrusters);
  Rates k1;
  Rates k2;
  Rates k3;
  Rates k4;
  rates(law, map, with_current, tau, state, sensitivity, k1);
  rates(law, map, with_current, tau, state + 0.5 * dt * k1.state,
        sensitivity + 0.5 * dt * k1.sensitivity, k2);
  rates(law, map, with_current, tau, state + 0.5 * dt * k2.state,
        sensitivity + 0.5 * dt * k2.sensitivity, k3);
  rates(law, map, with_current, tau, state + dt * k3.state, sensitivity + dt * k3.sensitivity, k4);
  state += dt / 6.0 * (k1.state + 2.0 * k2.state + 2.0 * k3.state + k4.state);
  sensitivity +=
      dt / 6.0 * (k1.sensitivity + 2.0 * k2.sensitivity + 2.0 * k3.sensitivity + k4.sensitivity);
}

State step(const Model& model, const vessel::Thrusts& thrusts, double dt, const State& state) {
  vessel::Disturbance disturbance;
  disturbance.current_mps = model.current_mps;
  return rk4Step(
      [&](double /*t*/, const State& x) {
        return vessel::stateDerivative(x, thrusts, model.coefficients, model.thrusters,
                                       disturbance);
      },
      0.0, state, dt);
}

}  // namespace otter_nav::identification
