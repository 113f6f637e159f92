// Mehrotra's predictor-corrector interior point method (Nocedal and Wright 2006, chapter 16.6). The
// barrier only touches the diagonal of the thrusts' Hessian, so a Newton step is the same Riccati
// recursion, and its correction a second pass for the gradient alone. It ends as soon as the active
// set it points to is the right one.
#pragma once

#include "tracker/qp/box_qp.hpp"

namespace otter_nav::tracker::qp {

// One bounded variable: its value, slacks and multipliers, and their Newton direction.
struct BarrierVariable {
  double value = 0.0;
  double bound[2] = {0.0, 0.0};  // lower, upper
  double slack[2] = {1.0, 1.0};  // not yet the distances to the bounds until a full step
  double multiplier[2] = {1.0, 1.0};
  double slack_step[2] = {0.0, 0.0};
  double multiplier_step[2] = {0.0, 0.0};
  double correction[2] = {0.0, 0.0};  // products of the predictor's steps

  // Slack and multipliers from a value that may lie outside the bounds.
  void start(double at, double lower, double upper, double stiffness);
  // What the barrier adds to the variable's quadratic cost, for complementarity `target`.
  [[nodiscard]] double curvature() const;
  [[nodiscard]] double gradient(double target) const;
  // Steps of slacks and multipliers once Newton's next value is known.
  void setStep(double next_value, double target);
  void keepCorrection();
  // The longest share of the step in (0, 1] that keeps slacks (multipliers) positive.
  [[nodiscard]] double longestPrimal() const;
  [[nodiscard]] double longestDual() const;
  void move(double next_value, double share);
  [[nodiscard]] double gap() const;
  [[nodiscard]] double gapAfter(double primal_share, double dual_share) const;
};

class InteriorPoint final : public Strategy {
 public:
  explicit InteriorPoint(int iterations) : iterations_(iterations) {}
  // From the du of `qp`, which may be out of bounds, and its last factors (for the multipliers'
  // size). du keeps to the bounds however it ends, dx follows it.
  [[nodiscard]] Outcome solve(BoxQp& qp) override;

 private:
  template <typename Visit>
  void forEach(const BoxQp& qp, Visit visit);
  double meanGap(const BoxQp& qp);
  void setCosts(const BoxQp& qp, double target);
  // The affine step, its corrections, and the complementarity to aim for.
  double predict(const BoxQp& qp, double gap);
  void correct(const BoxQp& qp, double target);
  // Takes the active set the iterate points to; true when it is the right one.
  [[nodiscard]] bool crossOver(BoxQp& qp);
  // The iterate, clamped, and the states it leads to.
  void take(BoxQp& qp);

  int iterations_;
  BarrierVariable variables_[kMaxStages][2];
  InputCosts costs_;  // the barrier's included
};

}  // namespace otter_nav::tracker::qp
