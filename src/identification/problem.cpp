#include "problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "otter_nav/base/parts.hpp"

namespace otter_nav::identification {
namespace {

using vessel::kStateSize;

// Longest RK4 step; slower odometry is bridged by several.
constexpr double kMaxStep = 0.1;

Sensitivity initialSensitivity(int shared, bool free_initial_state) {
  Sensitivity s = Sensitivity::Zero(kStateSize, shared + (free_initial_state ? kStateSize : 0));
  if (free_initial_state) {
    s.rightCols(kStateSize).setIdentity();
  }
  return s;
}

}  // namespace

Problem::Problem(const DataSet& data, std::vector<Stretch> windows, ParameterSet set,
                 vessel::Thrusters thrusters, const ProblemOptions& options)
    : data_(data),
      windows_(std::move(windows)),
      set_(std::move(set)),
      shared_(set_.parameters),
      thrusters_(thrusters),
      options_(options) {
  if (options.estimate_current) {
    for (const char* name : {"current_x_mps", "current_y_mps"}) {
      Parameter current;
      current.name = name;
      current.lower = -options.max_current_mps;
      current.upper = options.max_current_mps;
      shared_.push_back(current);
    }
  }
  const Deviations& d = options.deviations;
  inverse_deviation_ << 1.0 / d.position_m, 1.0 / d.position_m, 1.0 / d.heading_rad,
      1.0 / d.velocity_mps, 1.0 / d.velocity_mps, 1.0 / d.yaw_rate_radps;
  for (const Stretch& w : windows_) {
    residual_count_ += kStateSize * (w.end - w.begin);
  }
}

int Problem::sharedCount() const {
  return static_cast<int>(shared_.size());
}

int Problem::windowVariables() const {
  return options_.free_initial_states ? kStateSize : 0;
}

int Problem::variableCount() const {
  return sharedCount() + windowVariables() * static_cast<int>(windows_.size());
}

vessel::State Problem::initialDeviation() const {
  return inverse_deviation_.cwiseInverse();
}

vessel::State Problem::residual(const vessel::State& state, const Sample& sample) const {
  return inverse_deviation_.cwiseProduct(state - sample.state);
}

Model Problem::modelAt(const Eigen::VectorXd& variables) const {
  const Eigen::Index parameters = set_.map.cols();
  Model model;
  model.coefficients = modelOf<vessel::ManoeuvringModel>(set_.map * variables.head(parameters));
  model.thrusters = thrusters_;
  if (options_.estimate_current) {
    model.current_mps = variables.segment<2>(parameters);
  }
  return model;
}

Eigen::VectorXd Problem::startPoint() const {
  Eigen::VectorXd start = Eigen::VectorXd::Zero(variableCount());
  for (int i = 0; i < sharedCount(); ++i) {
    start[i] = shared_[static_cast<std::size_t>(i)].guess;
  }
  return start;
}

double Problem::evaluateWindow(std::size_t window, const Eigen::VectorXd& variables,
                               WindowTerms* terms) const {
  const Stretch& w = windows_[window];
  const Model model = modelAt(variables);
  const int shared = sharedCount();
  vessel::State state = data_.samples[w.begin].state;
  if (options_.free_initial_states) {
    state += variables.segment<kStateSize>(shared + kStateSize * static_cast<int>(window));
  }
  Sensitivity sensitivity;
  if (terms != nullptr) {
    sensitivity = initialSensitivity(shared, options_.free_initial_states);
    terms->gradient.setZero(sensitivity.cols());
    terms->hessian.setZero(sensitivity.cols(), sensitivity.cols());
  }
  double cost = 0.0;
  for (std::size_t i = w.begin; i < w.end; ++i) {
    const Sample& sample = data_.samples[i];
    const vessel::State error = residual(state, sample);
    cost += 0.5 * error.squaredNorm();
    if (terms != nullptr) {
      const Sensitivity j = inverse_deviation_.asDiagonal() * sensitivity;
      terms->gradient.noalias() += j.transpose().lazyProduct(error);
      terms->hessian.noalias() += j.transpose().lazyProduct(j);
    }
    if (i + 1 < w.end) {
      advance(model, sample, data_.samples[i + 1].time_s - sample.time_s, state,
              terms != nullptr ? &sensitivity : nullptr);
    }
  }
  return cost;
}

void Problem::advance(const Model& model, const Sample& sample, double dt, vessel::State& state,
                      Sensitivity* sensitivity) const {
  const int steps = partsOf(dt, kMaxStep);
  for (int k = 0; k < steps; ++k) {
    if (sensitivity != nullptr) {
      stepWithSensitivity(model, set_.map, options_.estimate_current, sample.thrusts, dt / steps,
                          state, *sensitivity);
    } else {
      state = step(model, sample.thrusts, dt / steps, state);
    }
  }
}

double Problem::priorCost(const Eigen::VectorXd& variables) const {
  double cost = 0.0;
  for (std::size_t i = 0; i < shared_.size(); ++i) {
    const double off =
        (variables[static_cast<Eigen::Index>(i)] - shared_[i].guess) / shared_[i].prior_sigma;
    cost += 0.5 * off * off;
  }
  return cost;
}

Eigen::VectorXd Problem::priorHessian() const {
  Eigen::VectorXd diagonal(sharedCount());
  for (std::size_t i = 0; i < shared_.size(); ++i) {
    diagonal[static_cast<Eigen::Index>(i)] =
        1.0 / (shared_[i].prior_sigma * shared_[i].prior_sigma);
  }
  return diagonal;
}

Eigen::VectorXd Problem::priorGradient(const Eigen::VectorXd& variables) const {
  const Eigen::Index shared = sharedCount();
  return priorHessian().cwiseProduct(variables.head(shared) - startPoint().head(shared));
}

}  // namespace otter_nav::identification
