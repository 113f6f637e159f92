// How well the data determine the parameters.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "problem.hpp"

namespace otter_nav::identification {

struct Uncertainty {
  Eigen::VectorXd standard_error;  // of the shared variables, zero for those at a bound
  std::vector<bool> at_bound;
};

// Standard errors at a solution, by the sandwich H^-1 (sum g g^T) H^-1 with g the gradient of one
// window: windows are taken as independent, residuals within one are not, since what the model
// lacks is correlated over seconds. H is the Gauss-Newton Hessian with the initial states
// eliminated.
[[nodiscard]] Uncertainty uncertainty(const Problem& problem, const Eigen::VectorXd& variables);

// An error naming the parameters that the data cannot determine: those in directions along which
// the residuals hardly change (relative standard error, from the deviations alone, above `limit`).
[[nodiscard]] Status checkIdentifiable(const Problem& problem, const Eigen::VectorXd& variables,
                                       double limit);

}  // namespace otter_nav::identification
