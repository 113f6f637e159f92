// Levenberg and Marquardt's way down the spline problem's objective.
#pragma once

#include <functional>

#include "optimizer/objective/spline_problem.hpp"

namespace otter_nav::optimizer {

class SplineSolver {
 public:
  struct Stop {
    int max_iterations = 12;
    double relative_decrease = 1e-3;  // smaller improvements end it
    // Asked before each iteration; empty: never out of time.
    std::function<bool()> out_of_time;
  };

  // The damping found is kept for the next call; this forgets it.
  void restart() { damping_ = kFirstDamping; }
  // Improves `spline` in place; returns the number of closed-form solutions made.
  int improve(const SplineProblem& problem, const Stop& stop, Spline& spline);

 private:
  static constexpr double kFirstDamping = 1e-2;

  Spline trial_;
  System system_;
  System trial_system_;
  double damping_ = kFirstDamping;
  double cost_ = 0.0;
};

}  // namespace otter_nav::optimizer
