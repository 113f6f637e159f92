#include "tracker/qp/interior_point.hpp"

#include <algorithm>

namespace otter_nav::tracker::qp {
namespace {

constexpr double kToBoundary = 0.995;   // of the way to where a slack or multiplier vanishes
constexpr double kCrossOverGap = 1e-5;  // of the first gap: from here the active set is tried
constexpr double kFinalGap = 1e-11;

// Distance to the lower bound grows with the value, to the upper it falls.
constexpr double kSign[2] = {1.0, -1.0};

double shareToZero(double value, double step) {
  return step < 0.0 ? std::min(1.0, -value / step) : 1.0;
}

}  // namespace

void BarrierVariable::start(double at, double lower, double upper, double stiffness) {
  const double range = upper - lower;
  value = at;
  bound[0] = lower;
  bound[1] = upper;
  for (int side = 0; side < 2; ++side) {
    const double distance = kSign[side] * (at - bound[side]);
    slack[side] = std::max(distance, 0.1 * range);
    multiplier[side] = stiffness * std::max(-distance, 0.1 * range);
    correction[side] = 0.0;
  }
}

double BarrierVariable::curvature() const {
  return multiplier[0] / slack[0] + multiplier[1] / slack[1];
}

double BarrierVariable::gradient(double target) const {
  double sum = -curvature() * value;
  for (int side = 0; side < 2; ++side) {
    const double residual = kSign[side] * (value - bound[side]) - slack[side];
    sum -= kSign[side] * (target - correction[side] - multiplier[side] * residual) / slack[side];
  }
  return sum;
}

void BarrierVariable::setStep(double next_value, double target) {
  for (int side = 0; side < 2; ++side) {
    slack_step[side] = kSign[side] * (next_value - bound[side]) - slack[side];
    multiplier_step[side] =
        (target - correction[side] - multiplier[side] * slack_step[side]) / slack[side] -
        multiplier[side];
  }
}

void BarrierVariable::keepCorrection() {
  for (int side = 0; side < 2; ++side) {
    correction[side] = slack_step[side] * multiplier_step[side];
  }
}

double BarrierVariable::longestPrimal() const {
  return std::min(shareToZero(slack[0], slack_step[0]), shareToZero(slack[1], slack_step[1]));
}

double BarrierVariable::longestDual() const {
  return std::min(shareToZero(multiplier[0], multiplier_step[0]),
                  shareToZero(multiplier[1], multiplier_step[1]));
}

void BarrierVariable::move(double next_value, double share) {
  value += share * (next_value - value);
  for (int side = 0; side < 2; ++side) {
    slack[side] += share * slack_step[side];
    multiplier[side] += share * multiplier_step[side];
    correction[side] = 0.0;
  }
}

double BarrierVariable::gap() const {
  return slack[0] * multiplier[0] + slack[1] * multiplier[1];
}

double BarrierVariable::gapAfter(double primal_share, double dual_share) const {
  double sum = 0.0;
  for (int side = 0; side < 2; ++side) {
    sum += (slack[side] + primal_share * slack_step[side]) *
           (multiplier[side] + dual_share * multiplier_step[side]);
  }
  return sum;
}

template <typename Visit>
void InteriorPoint::forEach(const BoxQp& qp, Visit visit) {
  for (int k = 0; k < qp.stages(); ++k) {
    for (int i = 0; i < 2; ++i) {
      visit(variables_[k][i], k, i);
    }
  }
}

double InteriorPoint::meanGap(const BoxQp& qp) {
  double sum = 0.0;
  forEach(qp, [&](const BarrierVariable& v, int, int) { sum += v.gap(); });
  return sum / (4.0 * qp.stages());
}

void InteriorPoint::setCosts(const BoxQp& qp, double target) {
  forEach(qp, [&](const BarrierVariable& v, int k, int i) {
    costs_[k].weight[i] = qp.input_costs[k].weight[i] + v.curvature();
    costs_[k].gradient[i] = qp.input_costs[k].gradient[i] + v.gradient(target);
  });
}

double InteriorPoint::predict(const BoxQp& qp, double gap) {
  double primal = 1.0;
  double dual = 1.0;
  forEach(qp, [&](BarrierVariable& v, int k, int i) {
    v.setStep(qp.du[k][i], 0.0);
    primal = std::min(primal, v.longestPrimal());
    dual = std::min(dual, v.longestDual());
  });
  double sum = 0.0;
  forEach(qp, [&](BarrierVariable& v, int, int) {
    sum += v.gapAfter(primal, dual);
    v.keepCorrection();
  });
  const double ratio = sum / (4.0 * qp.stages()) / gap;
  return ratio * ratio * ratio * gap;
}

void InteriorPoint::correct(const BoxQp& qp, double target) {
  double primal = 1.0;
  double dual = 1.0;
  forEach(qp, [&](BarrierVariable& v, int k, int i) {
    v.setStep(qp.du[k][i], target);
    primal = std::min(primal, v.longestPrimal());
    dual = std::min(dual, v.longestDual());
  });
  primal = primal < 1.0 ? kToBoundary * primal : 1.0;
  dual = dual < 1.0 ? kToBoundary * dual : 1.0;
  // One share for both: with different ones the curvature in the states' part of the dual
  // residual would not shrink.
  const double share = std::min(primal, dual);
  forEach(qp, [&](BarrierVariable& v, int k, int i) { v.move(qp.du[k][i], share); });
}

bool InteriorPoint::crossOver(BoxQp& qp) {
  forEach(qp, [&](const BarrierVariable& v, int k, int i) {
    const double stiffness = qp.input_costs[k].weight[i];
    qp.hold[k][i] = v.multiplier[0] > stiffness * v.slack[0]   ? Hold::kLower
                    : v.multiplier[1] > stiffness * v.slack[1] ? Hold::kUpper
                                                               : Hold::kFree;
  });
  if (!qp.factor(qp.stages() - 1)) {
    return false;
  }
  qp.rollOut();
  return qp.reviseHolds() < 0;
}

void InteriorPoint::take(BoxQp& qp) {
  forEach(qp, [&](const BarrierVariable& v, int k, int i) {
    qp.du[k][i] = std::clamp(v.value, v.bound[0], v.bound[1]);
  });
  qp.rollOutInputs();
}

Outcome InteriorPoint::solve(BoxQp& qp) {
  Outcome outcome;
  qp.freeAll();
  forEach(qp, [&](BarrierVariable& v, int k, int i) {
    v.start(qp.du[k][i], qp.lower[k][i], qp.upper[k][i], qp.feedback(k).hessian[i][i]);
  });
  const double first_gap = meanGap(qp);
  double gap = first_gap;
  while (outcome.iterations < iterations_ && gap >= kFinalGap * first_gap) {
    ++outcome.iterations;
    setCosts(qp, 0.0);
    if (!qp.factor(qp.stages() - 1, costs_)) {
      outcome.status = SolverStatus::kIndefinite;
      return outcome;
    }
    qp.rollOut();
    const double target = predict(qp, gap);
    setCosts(qp, target);
    qp.updateGradients(costs_);
    qp.rollOut();
    correct(qp, target);
    gap = meanGap(qp);
    if (gap < kCrossOverGap * first_gap && crossOver(qp)) {
      return outcome;
    }
    qp.freeAll();
  }
  take(qp);
  outcome.status =
      gap < kFinalGap * first_gap ? SolverStatus::kSolved : SolverStatus::kIterationsExhausted;
  return outcome;
}

}  // namespace otter_nav::tracker::qp
