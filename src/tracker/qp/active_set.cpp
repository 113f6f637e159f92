#include "tracker/qp/active_set.hpp"

namespace otter_nav::tracker::qp {

Outcome ActiveSet::solve(BoxQp& qp) {
  Outcome outcome;
  qp.rollOut();
  int changed = qp.reviseHolds();
  while (changed >= 0 && outcome.iterations < iterations_) {
    ++outcome.iterations;
    if (!qp.factor(changed)) {
      outcome.status = SolverStatus::kIndefinite;
      return outcome;
    }
    qp.rollOut();
    changed = qp.reviseHolds();
  }
  outcome.status = changed < 0 ? SolverStatus::kSolved : SolverStatus::kIterationsExhausted;
  return outcome;
}

}  // namespace otter_nav::tracker::qp
