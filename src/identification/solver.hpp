// The bounded least-squares problem solved with Ipopt, the Gauss-Newton Hessian supplied.
#pragma once

#include <Eigen/Core>

#include "otter_nav/base/result.hpp"
#include "otter_nav/identification/identify.hpp"
#include "problem.hpp"

namespace otter_nav::identification {

struct Solution {
  Eigen::VectorXd variables;  // of the problem
  double cost = 0.0;          // half the sum of squared residuals, priors included
  int iterations = 0;
};

[[nodiscard]] Result<Solution> solve(const Problem& problem, const Eigen::VectorXd& start,
                                     const SolverOptions& options);

}  // namespace otter_nav::identification
