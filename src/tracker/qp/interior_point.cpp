#include "tracker/qp/interior_point.hpp"

#include <algorithm>
#include <cmath>

#include "tracker/ocp/rti_solver.hpp"

namespace otter_nav::tracker {
namespace {

// Distance to the lower bound grows with the value, to the upper it falls.
constexpr double kSign[2] = {1.0, -1.0};

double shareToZero(double value, double step) {
  return step < 0.0 ? std::min(1.0, -value / step) : 1.0;
}

}  // namespace

void InteriorPoint::start(double at, double lower, double upper, double stiffness) {
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

double InteriorPoint::curvature() const {
  return multiplier[0] / slack[0] + multiplier[1] / slack[1];
}

double InteriorPoint::gradient(double target) const {
  double sum = -curvature() * value;
  for (int side = 0; side < 2; ++side) {
    const double residual = kSign[side] * (value - bound[side]) - slack[side];
    sum -= kSign[side] * (target - correction[side] - multiplier[side] * residual) / slack[side];
  }
  return sum;
}

void InteriorPoint::setStep(double next_value, double target) {
  for (int side = 0; side < 2; ++side) {
    slack_step[side] = kSign[side] * (next_value - bound[side]) - slack[side];
    multiplier_step[side] =
        (target - correction[side] - multiplier[side] * slack_step[side]) / slack[side] -
        multiplier[side];
  }
}

void InteriorPoint::keepCorrection() {
  for (int side = 0; side < 2; ++side) {
    correction[side] = slack_step[side] * multiplier_step[side];
  }
}

double InteriorPoint::longestPrimal() const {
  return std::min(shareToZero(slack[0], slack_step[0]), shareToZero(slack[1], slack_step[1]));
}

double InteriorPoint::longestDual() const {
  return std::min(shareToZero(multiplier[0], multiplier_step[0]),
                  shareToZero(multiplier[1], multiplier_step[1]));
}

void InteriorPoint::move(double next_value, double primal_share, double dual_share) {
  value += primal_share * (next_value - value);
  for (int side = 0; side < 2; ++side) {
    slack[side] += primal_share * slack_step[side];
    multiplier[side] += dual_share * multiplier_step[side];
    correction[side] = 0.0;
  }
}

double InteriorPoint::gap() const {
  return slack[0] * multiplier[0] + slack[1] * multiplier[1];
}

double InteriorPoint::gapAfter(double primal_share, double dual_share) const {
  double sum = 0.0;
  for (int side = 0; side < 2; ++side) {
    sum += (slack[side] + primal_share * slack_step[side]) *
           (multiplier[side] + dual_share * multiplier_step[side]);
  }
  return sum;
}

void RtiSolver::updateGradients(const std::array<InputCost, kMaxStages>& costs) {
  for (int k = options_.stages - 1; k >= 0; --k) {
    updateGradient(linear_[k], state_costs_[k], costs[k], values_[k + 1], values_[k],
                   feedbacks_[k]);
  }
}

bool RtiSolver::crossOver(const vessel::State& measured) {
  for (int k = 0; k < options_.stages; ++k) {
    for (int i = 0; i < 2; ++i) {
      const InteriorPoint& v = interior_[k][i];
      const double stiffness = input_costs_[k].weight[i];
      hold_[k][i] = v.multiplier[0] > stiffness * v.slack[0]   ? Hold::kLower
                    : v.multiplier[1] > stiffness * v.slack[1] ? Hold::kUpper
                                                               : Hold::kFree;
    }
  }
  if (!factor(options_.stages - 1, input_costs_)) {
    return false;
  }
  rollOutPlan(measured);
  return reviseHolds() < 0;
}

}  // namespace otter_nav::tracker
