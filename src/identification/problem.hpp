// The least-squares problem over rollouts (paper, equation 8): how far the model, driven by the
// recorded thrusts, strays from the recorded motion within each window.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/identification/identify.hpp"
#include "parameter_set.hpp"

namespace otter_nav::identification {

// Gradient of a window's cost and its Gauss-Newton Hessian over [parameters, current, initial
// state].
struct WindowTerms {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
};

// Variables: [parameters, current (if estimated), initial state of each window (if free)], in
// physical units; initial states as differences from the measured ones.
class Problem {
 public:
  Problem(const DataSet& data, std::vector<Stretch> windows, ParameterSet set,
          vessel::Thrusters thrusters, const ProblemOptions& options);

  [[nodiscard]] int sharedCount() const;  // parameters and current
  [[nodiscard]] int windowVariables() const;
  [[nodiscard]] int variableCount() const;
  [[nodiscard]] std::size_t windowCount() const { return windows_.size(); }
  [[nodiscard]] std::size_t residualCount() const { return residual_count_; }
  // The parameters and, if estimated, current_x and current_y.
  [[nodiscard]] const std::vector<Parameter>& shared() const { return shared_; }
  [[nodiscard]] vessel::State initialDeviation() const;

  // Half the sum of a window's squared residuals; its derivatives too unless `terms` is null.
  double evaluateWindow(std::size_t window, const Eigen::VectorXd& variables,
                        WindowTerms* terms) const;
  // Cost of the guess's priors, with gradient and the Hessian's diagonal over the shared ones.
  [[nodiscard]] double priorCost(const Eigen::VectorXd& variables) const;
  [[nodiscard]] Eigen::VectorXd priorGradient(const Eigen::VectorXd& variables) const;
  [[nodiscard]] Eigen::VectorXd priorHessian() const;

  [[nodiscard]] Eigen::VectorXd startPoint() const;
  [[nodiscard]] Model modelAt(const Eigen::VectorXd& variables) const;

 private:
  [[nodiscard]] vessel::State residual(const vessel::State& state, const Sample& sample) const;
  void advance(const Model& model, const Sample& sample, double dt, vessel::State& state,
               Sensitivity* sensitivity) const;

  const DataSet& data_;
  std::vector<Stretch> windows_;
  ParameterSet set_;
  std::vector<Parameter> shared_;
  vessel::Thrusters thrusters_;
  ProblemOptions options_;
  vessel::State inverse_deviation_;
  std::size_t residual_count_ = 0;
};

}  // namespace otter_nav::identification
