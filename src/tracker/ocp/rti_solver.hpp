// The real-time iteration: one SQP step a cycle with the Gauss-Newton Hessian, split into a
// preparation that needs no measurement and a feedback that only takes the state (Diehl, Bock and
// Schloeder 2005).
//
// The quadratic problem is factored with the last cycle's held thrusts in the preparation. Only
// when the feedback finds a bound violated or a multiplier of the wrong sign is it solved again: by
// active-set steps; should those cycle, by projected Newton steps, which cannot; and should those
// stall, by the interior point method.
#pragma once

#include <memory>
#include <vector>

#include "tracker/ocp/problem.hpp"
#include "tracker/ocp/shooting.hpp"
#include "tracker/qp/box_qp.hpp"

namespace otter_nav::tracker {

struct RtiOptions {
  // The most a step may turn any stage's heading; beyond, the plan takes a share of the step.
  double heading_step_rad = 1e3;
  // The share of each step that the plan takes at most. Whole steps may go to and fro between two
  // plans when thrust is spent.
  double step_share = 1.0;
  double finite_turn_rad = 0.0;  // of StageModel
  int active_set_iterations = 7;
  int projected_newton_iterations = 25;
  int interior_point_iterations = 30;
};

class RtiSolver {
 public:
  RtiSolver(const OcpOptions& problem, const RtiOptions& options,
            const vessel::ManoeuvringModel& model, const vessel::Thrusters& thrusters);

  void setDisturbance(const vessel::Disturbance& disturbance);
  void setWater(const std::array<WaterMotion, kMaxStages>& water) { model_.setWater(water); }
  void setWeights(const OcpWeights& weights) { problem_.setWeights(weights); }
  void limitRates(const vessel::Thrusts& acting, double rate_nps);  // see ControlProblem
  // Start from the reference (clamped to the bounds).
  void initialize(const OcpReference& reference);
  // Start from a hull at rest all along the reference, about which there always is a linearisation.
  void initializeAtRest(const OcpReference& reference);
  // Moves the plan on by `fraction` of a stage.
  void shift(double fraction);

  // Linearises about the plan and factors. On failure the plan is unchanged and feedback() fails.
  SolverStatus prepare(const OcpReference& reference);
  // Takes the measured state and moves the plan by the solution. On failure it is unchanged.
  SolverStatus feedback(const vessel::State& measured);

  [[nodiscard]] const std::array<vessel::State, kMaxStages + 1>& states() const {
    return plan_.states;
  }
  [[nodiscard]] const std::array<vessel::Thrusts, kMaxStages>& thrusts() const {
    return plan_.thrusts;
  }
  // Recursions over the horizon beyond the first, in the last feedback.
  [[nodiscard]] int iterations() const { return iterations_; }

 private:
  SolverStatus solve();
  [[nodiscard]] bool finite() const;
  void accept();

  RtiOptions options_;
  ControlProblem problem_;
  StageModel model_;
  Plan plan_;
  qp::BoxQp qp_;                                           // in deviations from the plan
  std::vector<std::unique_ptr<qp::Strategy>> strategies_;  // the first that doesn't give up counts
  SolverStatus prepared_ = SolverStatus::kNotFinite;
  int iterations_ = 0;
};

}  // namespace otter_nav::tracker
