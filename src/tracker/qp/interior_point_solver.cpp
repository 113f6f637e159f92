// The interior point part of the solver. The barrier only touches the diagonal of the thrusts'
// Hessian, so its Newton steps are the solver's own Riccati recursion.
#include <algorithm>

#include "tracker/ocp/rti_solver.hpp"

namespace otter_nav::tracker {
namespace {

constexpr double kToBoundary = 0.995;   // of the way to where a slack or multiplier vanishes
constexpr double kCrossOverGap = 1e-5;  // of the first gap: from here the active set is tried
constexpr double kFinalGap = 1e-11;

}  // namespace

void RtiSolver::startInterior() {
  for (int k = 0; k < options_.stages; ++k) {
    for (int i = 0; i < 2; ++i) {
      hold_[k][i] = Hold::kFree;
      interior_[k][i].start(du_[k][i], boundOf(k, i, Hold::kLower), boundOf(k, i, Hold::kUpper),
                            feedbacks_[k].hessian[i][i]);
    }
  }
}

template <typename Visit>
void RtiSolver::forEachInterior(Visit visit) {
  for (int k = 0; k < options_.stages; ++k) {
    for (int i = 0; i < 2; ++i) {
      visit(interior_[k][i], k, i);
    }
  }
}

double RtiSolver::meanGap() {
  double sum = 0.0;
  forEachInterior([&](const InteriorPoint& v, int, int) { sum += v.gap(); });
  return sum / (4.0 * options_.stages);
}

// The affine step, its corrections, and the complementarity to aim for.
double RtiSolver::predict(double gap) {
  double primal = 1.0;
  double dual = 1.0;
  forEachInterior([&](InteriorPoint& v, int k, int i) {
    v.setStep(du_[k][i], 0.0);
    primal = std::min(primal, v.longestPrimal());
    dual = std::min(dual, v.longestDual());
  });
  double sum = 0.0;
  forEachInterior([&](InteriorPoint& v, int, int) {
    sum += v.gapAfter(primal, dual);
    v.keepCorrection();
  });
  const double ratio = sum / (4.0 * options_.stages) / gap;
  return ratio * ratio * ratio * gap;
}

void RtiSolver::correct(double target) {
  double primal = 1.0;
  double dual = 1.0;
  forEachInterior([&](InteriorPoint& v, int k, int i) {
    v.setStep(du_[k][i], target);
    primal = std::min(primal, v.longestPrimal());
    dual = std::min(dual, v.longestDual());
  });
  primal = primal < 1.0 ? kToBoundary * primal : 1.0;
  dual = dual < 1.0 ? kToBoundary * dual : 1.0;
  // One share for both: with different ones the curvature in the states' part of the dual
  // residual would not shrink.
  const double share = std::min(primal, dual);
  forEachInterior([&](InteriorPoint& v, int k, int i) { v.move(du_[k][i], share, share); });
}

SolverStatus RtiSolver::iterateInteriorPoint(const vessel::State& measured) {
  const int n = options_.stages;
  startInterior();
  const double first_gap = meanGap();
  double gap = first_gap;
  for (int iteration = 0; iteration < options_.interior_point_iterations; ++iteration) {
    ++iterations_;
    const auto setCosts = [&](double target) {
      forEachInterior([&](const InteriorPoint& v, int k, int i) {
        barrier_costs_[k].weight[i] = input_costs_[k].weight[i] + v.curvature();
        barrier_costs_[k].gradient[i] = input_costs_[k].gradient[i] + v.gradient(target);
      });
    };
    setCosts(0.0);
    if (!factor(n - 1, barrier_costs_)) {
      return SolverStatus::kIndefinite;
    }
    rollOutPlan(measured);
    const double target = predict(gap);
    setCosts(target);
    updateGradients(barrier_costs_);
    rollOutPlan(measured);
    correct(target);
    gap = meanGap();
    if (gap < kCrossOverGap * first_gap && crossOver(measured)) {
      return SolverStatus::kSolved;
    }
    forEachInterior([&](const InteriorPoint&, int k, int i) { hold_[k][i] = Hold::kFree; });
    if (gap < kFinalGap * first_gap) {
      break;
    }
  }
  takeInterior();
  return gap < kFinalGap * first_gap ? SolverStatus::kSolved : SolverStatus::kIterationsExhausted;
}

// The iterate, clamped, and the states it leads to.
void RtiSolver::takeInterior() {
  for (int k = 0; k < options_.stages; ++k) {
    for (int i = 0; i < 2; ++i) {
      const InteriorPoint& v = interior_[k][i];
      du_[k][i] = std::clamp(v.value, v.bound[0], v.bound[1]);
    }
    advance(linear_[k], dx_[k], du_[k], dx_[k + 1]);
  }
}

}  // namespace otter_nav::tracker
