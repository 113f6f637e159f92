// The paper's global optimisation (section V-A) carried further: from a way (polyline, tree of
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
// manoeuvres of their own (end_manoeuvre.hpp), and the spline between them is under way throughout.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

struct GlobalOptions {
  double clearance_margin_m = 0.05;  // beyond it, aimed at
  double spin_angle_rad = 0.4;       // turns at the goal wider than this are spun where it stops
  double drift_mps = 0.3;            // speed left when that begins
  double surge_ramp_s = 0.3;         // to full ahead at the start, and at the stop to nothing
  double brake_ramp_s = 0.4;         // from ahead to astern
  double astern_share = 0.9;         // of the force, while braking
  double arrival_speed_share = 0.6;  // of the speed aimed at, when the brake begins
  // A trajectory that asks for this share too much of a thruster is slowed down to suit.
  double dilation_max = 0.06;
  double piece_length_m = 17.0;
  // Weights: of a second, of a metre of way, and the paper's.
  double weight_time = 1.0;
  double weight_length = 0.1;
  double weight_smooth = 0.1;        // ls, on the integral of squared jerk
  double weight_clearance = 20.0;    // lc
  double weight_dynamics = 5.0;      // ld
  double weight_original = 0.3;      // lo, while the first shape is found
  double weight_smooth_first = 0.1;  // ls then
  double weight_growth = 1.5;        // of lc and ld from round to round where they fail
  int rounds = 5;
  int quicken_rounds = 2;       // after the first sound result
  double quicken_growth = 2.0;  // of weight_time, in each of them
  int iterations_per_round = 12;
};

// config/optimizer.yaml: mapping `global`.
[[nodiscard]] Result<GlobalOptions> readGlobalOptions(config::Section section);

// When to stop improving. A first feasible trajectory is sought within `max_iterations` steps and
// the time; without a clock (empty `elapsed_s`) the result is the same on every machine.
struct Budget {
  std::function<double()> elapsed_s;
  double budget_s = 0.1;
  int max_iterations = 300;
  // Attempts along the way given, each more careful than the one before; with fewer than all there
  // is no last resort either.
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
                                           const std::vector<Eigen::Vector2d>& way,
                                           const trajectory::Boundary& start,
                                           const trajectory::Boundary& goal, const Budget& budget,
                                           const feasibility::SafetyLimits& limits);
  // From a trajectory: the tree's quintics (any continuity), or one being sailed.
  [[nodiscard]] Result<Optimized> optimize(const feasibility::Obstacles& obstacles,
                                           const trajectory::Trajectory& initial,
                                           const trajectory::Boundary& start,
                                           const trajectory::Boundary& goal, const Budget& budget,
                                           const feasibility::SafetyLimits& limits);

  // From rest, straight from point to point of a clear polyline, stopping at each to turn: slow,
  // but sound wherever the hull may turn.
  [[nodiscard]] Result<Optimized> stopAndSpin(const feasibility::Obstacles& obstacles,
                                              const std::vector<Eigen::Vector2d>& way,
                                              const trajectory::Boundary& start,
                                              const trajectory::Boundary& goal,
                                              const feasibility::SafetyLimits& limits);

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace otter_nav::optimizer
