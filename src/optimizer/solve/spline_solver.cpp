#include "optimizer/solve/spline_solver.hpp"

#include <algorithm>
#include <utility>

namespace otter_nav::optimizer {
namespace {

constexpr double kMostKeptDamping = 1.0;
constexpr double kLeastDamping = 1e-8;
constexpr double kMostDamping = 1e6;
constexpr double kFloor = 1e-9;

}  // namespace

int SplineSolver::improve(const SplineProblem& problem, const Stop& stop, Spline& spline) {
  double& damping = damping_;
  damping = std::min(damping, kMostKeptDamping);
  cost_ = problem.evaluate(spline, &system_);
  int iterations = 0;
  int small_steps = 0;
  while (iterations < stop.max_iterations && damping < kMostDamping) {
    if (stop.out_of_time && stop.out_of_time()) {
      break;
    }
    ++iterations;
    if (!system_.solve(damping, kFloor)) {
      damping = std::max(10.0 * damping, kFirstDamping);
      continue;
    }
    trial_ = spline;
    SplineProblem::apply(system_.solution(), 1.0, trial_);
    const double cost = problem.evaluate(trial_, &trial_system_);
    if (!(cost < cost_)) {
      damping *= 6.0;
      continue;
    }
    const double decrease = (cost_ - cost) / std::max(cost, 1e-9);
    std::swap(spline, trial_);
    std::swap(system_, trial_system_);
    cost_ = cost;
    damping = std::max(0.2 * damping, kLeastDamping);
    small_steps = decrease < stop.relative_decrease ? small_steps + 1 : 0;
    if (small_steps >= 2) {
      break;
    }
  }
  return iterations;
}

}  // namespace otter_nav::optimizer
