// One bounded variable of the interior point method: its value, slacks and multipliers, and the
// Newton direction of Mehrotra's predictor-corrector scheme (Nocedal and Wright 2006,
// chapter 16.6).
#pragma once

namespace otter_nav::tracker {

struct InteriorPoint {
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
  void move(double next_value, double primal_share, double dual_share);
  [[nodiscard]] double gap() const;
  [[nodiscard]] double gapAfter(double primal_share, double dual_share) const;
};

}  // namespace otter_nav::tracker
