// One RK4 step of the model with its exact derivatives (paper, equation 7), so that the gradient of
// a rollout is the gradient of what is computed, not an approximation of it.
#pragma once

#include <Eigen/Core>

#include "coefficients.hpp"
#include "otter_nav/identification/identify.hpp"
#include "otter_nav/vessel/model.hpp"

namespace otter_nav::identification {

// Free parameters, current, initial state.
constexpr int kMaxParameters = kCoefficientCount + 2;
constexpr int kMaxColumns = kMaxParameters + vessel::kStateSize;

// d state / d (parameters, initial state).
using Sensitivity =
    Eigen::Matrix<double, vessel::kStateSize, Eigen::Dynamic, 0, vessel::kStateSize, kMaxColumns>;
// Parameters to coefficients.
using CoefficientMap =
    Eigen::Matrix<double, kCoefficientCount, Eigen::Dynamic, 0, kCoefficientCount, kMaxParameters>;

// Advances `state` and its sensitivity by one step of dt seconds. `map` is d coefficients /
// d parameters; with `with_current` the two columns after the parameters are the current's. The
// remaining columns are those of the initial state.
void stepWithSensitivity(const Model& model, const CoefficientMap& map, bool with_current,
                         const vessel::Thrusts& thrusts, double dt, vessel::State& state,
                         Sensitivity& sensitivity);

// The state alone.
[[nodiscard]] vessel::State step(const Model& model, const vessel::Thrusts& thrusts, double dt,
                                 const vessel::State& state);

}  // namespace otter_nav::identification
