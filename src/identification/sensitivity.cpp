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

// A state in the first column, its sensitivity in those after it.
using Augmented = Eigen::Matrix<double, kStateSize, Eigen::Dynamic, 0, kStateSize, 1 + kMaxColumns>;

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
  const auto acceleration = vessel::bodyAcceleration(
      law.coefficients, law.mobility, psi.cosine, psi.sine, vessel::Body{0.0, 0.0, 0.0}, current_x,
      current_y, u, v, r, tau.surge_n, tau.yaw_nm);
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

Augmented rates(const Law& law, const CoefficientMap& map, bool with_current,
                const vessel::Tau& tau, const Augmented& x) {
  State rate;
  const RateJacobian j = rateJacobian(law, tau, x.col(0), rate);
  Augmented out(kStateSize, x.cols());
  out.col(0) = rate;
  // Nothing depends on the position: only the columns from the heading on.
  auto sensitivity = out.rightCols(x.cols() - 1);
  sensitivity.noalias() = j.middleCols<4>(kByPsi).lazyProduct(x.bottomRightCorner(4, x.cols() - 1));
  const Eigen::Index parameters = map.cols();
  sensitivity.bottomLeftCorner(3, parameters).noalias() +=
      j.bottomLeftCorner<3, kCoefficientCount>().lazyProduct(map);
  if (with_current) {
    sensitivity.block(3, parameters, 3, 2) += j.bottomRightCorner<3, 2>();
  }
  return out;
}

}  // namespace

void stepWithSensitivity(const Model& model, const CoefficientMap& map, bool with_current,
                         const vessel::Thrusts& thrusts, double dt, State& state,
                         Sensitivity& sensitivity) {
  const Law law(model);
  const vessel::Tau tau = vessel::tauFromThrusts(thrusts, model.thrusters);
  Augmented x(kStateSize, 1 + sensitivity.cols());
  x << state, sensitivity;
  x = rk4Step(
      [&](double /*t*/, const Augmented& at) { return rates(law, map, with_current, tau, at); },
      0.0, x, dt);
  state = x.col(0);
  sensitivity = x.rightCols(sensitivity.cols());
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
