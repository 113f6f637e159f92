// The paper's global optimisation (section V-A) carried further: from a path (polyline, tree of
// quintics, or the trajectory being sailed) to a trajectory of degree 7, continuous to the third
// derivative, within both thrusters' limits and clear of obstacles, in little time.
//
//   F = ls fs + lc fc + ld fd + lo fo  (+ time and length)
//
// over the knots' position, velocity, acceleration and jerk and the pieces' durations. Each round
// takes F's quadratic model (Gauss-Newton with Levenberg's damping) and minimises it in closed
// form: the Hessian is block-tridiagonal, so a step costs time linear in the number of pieces.
// Weights of constraints that still fail are raised from round to round; the result is verified.
//
// Ends at rest: there |w| vanishes (see vessel/inverse_dynamics.hpp), so launch and arrival are
// manoeuvres of their own (ends.hpp), and the spline between them is under way throughout.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

// What a trajectory is worth beside its seconds; what it must keep to comes with each call.
struct GlobalOptions {
  double weight_length = 0.1;
  double weight_smooth = 0.1;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("weight_length", o.weight_length, {0.0, 1e3}, "seconds a metre of path is worth");
    fields("weight_smooth", o.weight_smooth, {1e-6, 1e3},
           "seconds that a unit of the integral of squared jerk, m^2/s^5, is worth");
  }
};

// When to stop improving. A first feasible trajectory is sought within `max_iterations` steps and
// the time; without a clock (empty `elapsed_s`) the result is the same on every machine.
struct Budget {
  std::function<double()> elapsed_s;
  double budget_s = 0.1;
  int max_iterations = 300;
  // Of a call: steps times the pieces of the spline and what the ends and verification take, in
  // pieces. A measure of its time that is the same on every machine.
  int max_work = std::numeric_limits<int>::max();
  // Attempts along the path given, each more careful than the one before: from which on, and up to
  // which. Before the last there is no last resort either.
  int first_attempt = 0;
  int max_attempts = 4;
};

struct Optimized {
  trajectory::Trajectory trajectory;
  feasibility::Verification verification;  // ok
  int iterations = 0;                      // closed-form solutions made
  bool last_resort = false;                // stop-and-spin along the polyline: true, but slow
};

// Not thread-safe: its workspace is reused from call to call.
class GlobalOptimizer {
 public:
  GlobalOptimizer(const GlobalOptions& options, const vessel::Parameters& vessel);
  ~GlobalOptimizer();
  GlobalOptimizer(GlobalOptimizer&&) noexcept;
  GlobalOptimizer& operator=(GlobalOptimizer&&) noexcept;

  // Along a polyline from start to goal (a guide path): at least two points; its ends are taken
  // from the boundaries. What is returned has passed the verifier with `limits`.
  [[nodiscard]] Result<Optimized> optimize(const feasibility::Obstacles& obstacles,
                                           const std::vector<Eigen::Vector2d>& path,
                                           const trajectory::Boundary& start,
                                           const trajectory::Boundary& goal, const Budget& budget,
                                           const feasibility::SafetyLimits& limits);
  // From a trajectory: the tree's quintics (any continuity), or one being sailed.
  [[nodiscard]] Result<Optimized> optimize(const feasibility::Obstacles& obstacles,
                                           const trajectory::Trajectory& initial,
                                           const trajectory::Boundary& start,
                                           const trajectory::Boundary& goal, const Budget& budget,
                                           const feasibility::SafetyLimits& limits);

  // What the last call of these took, found or not, as Budget::max_work counts.
  [[nodiscard]] int work() const;

  // From rest, straight from point to point of a clear polyline, stopping at each to turn: slow,
  // but feasible wherever the hull may turn.
  [[nodiscard]] Result<Optimized> stopAndSpin(const feasibility::Obstacles& obstacles,
                                              const std::vector<Eigen::Vector2d>& path,
                                              const trajectory::Boundary& start,
                                              const trajectory::Boundary& goal,
                                              const feasibility::SafetyLimits& limits);

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace otter_nav::optimizer
