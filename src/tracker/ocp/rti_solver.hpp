// The tracker's optimal control problem and its real-time iteration: one SQP step a cycle with the
// Gauss-Newton Hessian, split into a preparation that needs no measurement and a feedback that only
// takes the state (Diehl, Bock and Schloeder 2005).
//
//   min  sum_{k<N} 1/2 |x_k - xr_k|_Q^2 + 1/2 |F_k - Fr_k|_R^2  +  1/2 |x_N - xr_N|_QN^2
//   s.t. x_0 measured, x_{k+1} = RK4(x_k, F_k), lower <= F_k <= upper      (paper, section V-B)
//
// The quadratic problem is factored without its inequalities (or with the last cycle's active
// bounds) in the preparation. Only when the feedback finds a bound violated or a multiplier of the
// wrong sign is it solved again: by primal-dual active-set steps, each one Riccati recursion over
// the stages before the last change; should those cycle, by projected Newton steps, which cannot;
// and should those stall, by Mehrotra's predictor-corrector interior point method, each iteration
// one recursion and a second pass for the gradient alone.
#pragma once

#include <array>

#include "otter_nav/tracker/limits.hpp"
#include "otter_nav/tracker/solver_status.hpp"
#include "tracker/ocp/shooting.hpp"
#include "tracker/qp/interior_point.hpp"
#include "tracker/qp/riccati.hpp"

namespace otter_nav::tracker {

// Q, R and QN as they stand in the sum above.
struct OcpWeights {
  vessel::State state = vessel::State::Ones();
  vessel::State terminal = vessel::State::Ones();
  vessel::Thrusts thrusts = vessel::Thrusts::Ones();
};

struct OcpOptions {
  int stages = 20;
  double step_s = 0.1;
  OcpWeights weights;
  vessel::Thrusts lower_n = vessel::Thrusts::Constant(-50.0);
  vessel::Thrusts upper_n = vessel::Thrusts::Constant(50.0);
  double regularization = 1e-9;  // added to the thrusts' Hessian
  // Position errors e cost far_m^2 (sqrt(1 + (e / far_m)^2) - 1) times their weight (Charbonnier's
  // loss): as e^2 / 2 when near, in proportion when far, so that a vessel blown off its way does
  // not make the problem ever stiffer. x and y weigh alike.
  double far_m = 1e3;
  // The most a step may turn any stage's heading; beyond, the plan takes a share of the step.
  double heading_step_rad = 1e3;
  // The share of each step that the plan takes at most. Whole steps may go to and fro between two
  // plans when thrust is spent.
  double step_share = 1.0;
  int active_set_iterations = 7;
  int projected_newton_iterations = 25;
  int interior_point_iterations = 30;
};

// psi of all states is continuous along the horizon and near the measured one. `attitude` in [0, 1]
// scales the weights of a stage's heading, surge and sway: how far the reference means them.
struct OcpReference {
  OcpReference() { attitude.fill(1.0); }

  std::array<vessel::State, kMaxStages + 1> states;
  std::array<double, kMaxStages + 1> attitude;
  std::array<vessel::Thrusts, kMaxStages> thrusts;
};

// What the loss above leaves of the position's weight at an error, 0 to 1.
[[nodiscard]] double nearness(const vessel::State& x, const vessel::State& reference, double far_m);

class RtiSolver {
 public:
  RtiSolver(const OcpOptions& options, const vessel::ManoeuvringModel& model,
            const vessel::Thrusters& thrusters);

  void setDisturbance(const vessel::Disturbance& disturbance);
  void setWeights(const OcpWeights& weights) { options_.weights = weights; }
  // Narrows each stage's bounds to what the thrusts can reach by its middle from `acting` at
  // `rate_nps`. The differences between later stages stay free: the tube holds all plans that keep
  // the rate, and the first stage, the one that is commanded, keeps it. A box, so the problem keeps
  // its shape.
  void limitRates(const vessel::Thrusts& acting, double rate_nps);
  // Start from the reference (clamped to the bounds).
  void initialize(const OcpReference& reference);
  // Moves the plan on by `fraction` of a stage.
  void shift(double fraction);

  // Linearises about the plan and factors. On failure the plan is unchanged and feedback() fails.
  SolverStatus prepare(const OcpReference& reference);
  // Takes the measured state and moves the plan by the solution. On failure it is unchanged.
  SolverStatus feedback(const vessel::State& measured);

  [[nodiscard]] const std::array<vessel::State, kMaxStages + 1>& states() const { return states_; }
  [[nodiscard]] const std::array<vessel::Thrusts, kMaxStages>& thrusts() const { return thrusts_; }
  [[nodiscard]] int stages() const { return options_.stages; }
  // Recursions over the horizon beyond the first, in the last feedback.
  [[nodiscard]] int iterations() const { return iterations_; }
  // Largest change of the plan in the last feedback, relative to the thrusts' range.
  [[nodiscard]] double lastStep() const { return last_step_; }

 private:
  using Deviation = double[6];
  using Inputs = double[kMaxStages][2];
  void setCosts(const OcpReference& reference);
  // Recursion from stage `from` down to 0 with the bounds in `hold_`.
  [[nodiscard]] bool factor(int from, const std::array<InputCost, kMaxStages>& costs);
  void rollOutPlan(const vessel::State& measured);
  // Revises `hold_` from the last roll-out: the highest stage changed, or -1.
  [[nodiscard]] int reviseHolds();
  SolverStatus iterateActiveSet(const vessel::State& measured);
  SolverStatus iterateProjectedNewton(const vessel::State& measured);
  double startProjectedNewton();
  // dx_ from du_; the cost.
  double rollOutThrusts();
  double rollOutClipped(bool& clipped);
  [[nodiscard]] double stageCost(int k) const;
  void differentiateThrusts();
  // Holds the thrusts at a bound that the gradient presses against: the highest stage where that
  // differs from what is factored, or -1.
  [[nodiscard]] int holdPressed();
  [[nodiscard]] bool moveWithin(const Inputs& from, double& cost);
  // du at which a thruster of a stage meets a bound.
  [[nodiscard]] double boundOf(int stage, int thruster, Hold hold) const;
  SolverStatus iterateInteriorPoint(const vessel::State& measured);
  void startInterior();
  double meanGap();
  double predict(double gap);
  void correct(double target);
  void takeInterior();
  template <typename Visit>
  void forEachInterior(Visit visit);
  // Takes the active set the interior point iterate points to; true when it is the right one.
  [[nodiscard]] bool crossOver(const vessel::State& measured);
  // The gradient part of factor() with the gains it found.
  void updateGradients(const std::array<InputCost, kMaxStages>& costs);
  [[nodiscard]] bool finite() const;
  void accept();

  OcpOptions options_;
  StageModel model_;
  std::array<vessel::State, kMaxStages + 1> states_;
  std::array<vessel::Thrusts, kMaxStages> thrusts_;
  std::array<Stage, kMaxStages + kLanes> linear_;
  std::array<StateCost, kMaxStages + 1> state_costs_;
  std::array<InputCost, kMaxStages> input_costs_;
  std::array<Value, kMaxStages + 1> values_;
  std::array<Feedback, kMaxStages> feedbacks_;
  std::array<InputCost, kMaxStages> barrier_costs_;
  InteriorPoint interior_[kMaxStages][2];
  Hold hold_[kMaxStages][2];
  Hold factored_[kMaxStages][2];  // by the last projected Newton step
  Deviation dx_[kMaxStages + 1];
  std::array<vessel::Thrusts, kMaxStages> lower_;
  std::array<vessel::Thrusts, kMaxStages> upper_;
  Inputs du_;
  Inputs last_du_;
  Inputs newton_;
  Inputs thrust_gradient_;
  SolverStatus prepared_ = SolverStatus::kNotFinite;
  int iterations_ = 0;
  double last_step_ = 0.0;
};

}  // namespace otter_nav::tracker
