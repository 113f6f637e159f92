// Primal-dual active-set steps (Hintermueller, Ito and Kunisch 2002, SIAM J. Optim. 13(3)): all
// thrusts beyond a bound are held and all with a multiplier of the wrong sign freed at once, then
// the recursion is done again over the stages before the last change. From the last cycle's held
// set one or two do as a rule; in saturation the steps may cycle, hence their limit.
#pragma once

#include "tracker/qp/box_qp.hpp"

namespace otter_nav::tracker::qp {

class ActiveSet final : public Strategy {
 public:
  explicit ActiveSet(int iterations) : iterations_(iterations) {}
  // From the held set that `qp` is factored with. Without iterations left du may be out of bounds.
  [[nodiscard]] Outcome solve(BoxQp& qp) override;

 private:
  int iterations_;
};

}  // namespace otter_nav::tracker::qp
