// A quadratic problem over the horizon with bounds on the thrusts,
//
//   min  sum_{k<N} 1/2 dx_k'Q_k dx_k + q_k'dx_k + 1/2 du_k'R_k du_k + r_k'du_k
//        + 1/2 dx_N'Q_N dx_N + q_N'dx_N
//   s.t. dx_0 given, dx_{k+1} = A_k dx_k + B_k du_k + c_k, lower_k <= du_k <= upper_k,
//
// with Q and R diagonal, and what every strategy for the bounds is made of: the recursion with some
// thrusts held at a bound, roll-outs, and the test of optimality. The strategies are classes of
// their own beside this one: each takes a factored problem and leaves du, dx and the held set.
#pragma once

#include <array>

#include "otter_nav/tracker/limits.hpp"
#include "otter_nav/tracker/solver_status.hpp"
#include "tracker/qp/riccati.hpp"

namespace otter_nav::tracker::qp {

using Deviation = double[6];
using Inputs = double[kMaxStages][2];
using Holds = Hold[kMaxStages][2];
using InputCosts = std::array<InputCost, kMaxStages>;

// How a strategy ended, after how many recursions over (part of) the horizon.
struct Outcome {
  SolverStatus status = SolverStatus::kSolved;
  int iterations = 0;
};

class BoxQp {
 public:
  explicit BoxQp(int stages);

  [[nodiscard]] int stages() const { return stages_; }
  // du at which a thruster of a stage meets a bound.
  [[nodiscard]] double bound(int stage, int thruster, Hold side) const {
    return (side == Hold::kLower ? lower : upper)[stage][thruster];
  }
  [[nodiscard]] double clampToBounds(int stage, int thruster, double value) const;
  void freeAll();

  // The recursion from stage `from` down to 0 with the thrusts of `hold` at their bounds, for
  // `inputs` instead of the problem's own costs of the thrusts. False when what is free has no
  // minimum. The stages behind `from` must have been factored as they are.
  [[nodiscard]] bool factor(int from, const InputCosts& inputs);
  [[nodiscard]] bool factor(int from) { return factor(from, input_costs); }
  [[nodiscard]] bool factor();  // all, the horizon's end included
  // The gradient part of factor() with the gains it found.
  void updateGradients(const InputCosts& inputs);
  [[nodiscard]] const Feedback& feedback(int stage) const { return feedbacks_[stage]; }

  // dx and du from dx[0] by the feedback found.
  void rollOut();
  // The same with each thrust clipped to its bounds on the way: the cost.
  double rollOutClipped(bool& clipped);
  // dx from dx[0] and du: the cost.
  double rollOutInputs();
  // Revises `hold` after rollOut(): free thrusts beyond a bound are held, held ones that the
  // gradient draws inside freed. The highest stage changed; -1: du is the problem's solution.
  [[nodiscard]] int reviseHolds();

  // The problem.
  std::array<Stage, kMaxStages + kLanes> linear;  // shooting fills whole packs of stages
  std::array<StateCost, kMaxStages + 1> state_costs;
  InputCosts input_costs;
  Inputs lower;
  Inputs upper;
  // The iterate. dx[0] is the problem's, `hold` also the next factor()'s.
  Deviation dx[kMaxStages + 1];
  Inputs du;
  Holds hold;

 private:
  [[nodiscard]] double stageCost(int k) const;

  int stages_;
  std::array<Value, kMaxStages + 1> values_;
  std::array<Feedback, kMaxStages> feedbacks_;
};

// One way to solve it.
class Strategy {
 public:
  virtual ~Strategy() = default;
  [[nodiscard]] virtual Outcome solve(BoxQp& qp) = 0;
};

}  // namespace otter_nav::tracker::qp
