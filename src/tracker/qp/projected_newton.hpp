// Projected Newton steps (Bertsekas 1982, SIAM J. Control Optim. 20(2)): thrusts at a bound that
// the gradient presses against are held, the others take Newton's step, and the move is bent back
// into the bounds and shortened until the cost falls. Unlike the plain active-set steps it cannot
// cycle; the held set is right after a few steps.
#pragma once

#include "tracker/qp/box_qp.hpp"

namespace otter_nav::tracker::qp {

class ProjectedNewton final : public Strategy {
 public:
  explicit ProjectedNewton(int iterations) : iterations_(iterations) {}
  // From the better of the feedback that `qp` is factored with, clipped, and du = 0 (within the
  // bounds). du keeps to the bounds however it ends.
  [[nodiscard]] Outcome solve(BoxQp& qp) override;

 private:
  double start(BoxQp& qp);
  void differentiate(const BoxQp& qp);
  // Holds the thrusts at a bound that the gradient presses against: the highest stage where that
  // differs from what is factored, or -1.
  [[nodiscard]] int holdPressed(BoxQp& qp);
  // Moves from the last inputs towards du as far as the cost falls; false where it doesn't.
  [[nodiscard]] bool moveWithin(BoxQp& qp, double& cost);
  void keep(const BoxQp& qp);

  int iterations_;
  Holds factored_{};  // by the last step
  Inputs last_du_;
  Inputs newton_;
  Inputs gradient_;  // of the cost over the thrusts
};

}  // namespace otter_nav::tracker::qp
