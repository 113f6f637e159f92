// Projected Newton steps on the quadratic problem (Bertsekas 1982, SIAM J. Control Optim. 20(2)):
// thrusts at a bound that the gradient presses against are held, the others take Newton's step, and
// the move is bent back into the bounds and shortened until the cost falls. Unlike the plain
// active-set steps it cannot cycle; the held set is right after a few steps.
#include <algorithm>
#include <cmath>

#include "tracker/ocp/rti_solver.hpp"

namespace otter_nav::tracker {
namespace {

constexpr double kAtBoundN = 1e-9;
constexpr double kShortestShare = 1.0 / 64.0;
constexpr double kRounding = 1e-12;
constexpr double kSufficient = 1e-4;  // of the decrease the gradient promises

double dot(Pack a, Pack b) {
  const Pack p = a * b;
  return (p[0] + p[1]) + (p[2] + p[3]);
}

Pack coupled(const double (&dx)[6]) {
  return Pack{dx[2], dx[3], dx[4], dx[5]};
}

double costOf(const StateCost& c, const double (&dx)[6]) {
  const Pack q = coupled(dx);
  double cost = dot(0.5 * c.weight_q * q + c.gradient_q, q);
  for (int i = 0; i < 2; ++i) {
    cost += (0.5 * c.weight_p[i] * dx[i] + c.gradient_p[i]) * dx[i];
  }
  return cost;
}

}  // namespace

double RtiSolver::boundOf(int stage, int thruster, Hold hold) const {
  return (hold == Hold::kLower ? lower_ : upper_)[stage][thruster] - thrusts_[stage][thruster];
}

double RtiSolver::rollOutThrusts() {
  double cost = 0.0;
  for (int k = 0; k < options_.stages; ++k) {
    cost += stageCost(k);
    advance(linear_[k], dx_[k], du_[k], dx_[k + 1]);
  }
  return cost + costOf(state_costs_[options_.stages], dx_[options_.stages]);
}

// The cost's gradient over the thrusts by the adjoint recursion, at dx_ and du_.
void RtiSolver::differentiateThrusts() {
  const int n = options_.stages;
  const auto slope = [&](int k, Pack& q, double(&p)[2]) {
    const StateCost& c = state_costs_[k];
    q = c.weight_q * coupled(dx_[k]) + c.gradient_q;
    for (int i = 0; i < 2; ++i) {
      p[i] = c.weight_p[i] * dx_[k][i] + c.gradient_p[i];
    }
  };
  Pack q;
  double p[2];
  slope(n, q, p);
  for (int k = n - 1; k >= 0; --k) {
    const Stage& s = linear_[k];
    const double adjoint[6] = {p[0], p[1], q[0], q[1], q[2], q[3]};
    Pack back = adjoint[0] * s.a[0];
    Pack input_part = adjoint[0] * s.bc[0];
    for (int row = 1; row < 6; ++row) {
      back += adjoint[row] * s.a[row];
      input_part += adjoint[row] * s.bc[row];
    }
    for (int i = 0; i < 2; ++i) {
      const InputCost& c = input_costs_[k];
      thrust_gradient_[k][i] = c.weight[i] * du_[k][i] + c.gradient[i] + input_part[i];
    }
    slope(k, q, p);
    q += back;
    p[0] += adjoint[0];
    p[1] += adjoint[1];
  }
}

int RtiSolver::holdPressed() {
  int highest = -1;
  for (int k = 0; k < options_.stages; ++k) {
    for (int i = 0; i < 2; ++i) {
      const double gradient = thrust_gradient_[k][i];
      const bool low = du_[k][i] <= boundOf(k, i, Hold::kLower) + kAtBoundN;
      const bool high = du_[k][i] >= boundOf(k, i, Hold::kUpper) - kAtBoundN;
      hold_[k][i] = low && gradient > 0.0    ? Hold::kLower
                    : high && gradient < 0.0 ? Hold::kUpper
                                             : Hold::kFree;
      if (hold_[k][i] != factored_[k][i]) {
        factored_[k][i] = hold_[k][i];
        highest = k;
      }
    }
  }
  return highest;
}

// Moves from `from` towards du_ as far as the cost falls; false where it doesn't.
bool RtiSolver::moveWithin(const Inputs& from, double& cost) {
  const int n = options_.stages;
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < 2; ++i) {
      newton_[k][i] = du_[k][i] - from[k][i];
    }
  }
  for (double share = 1.0; share >= kShortestShare; share *= 0.5) {
    double promised = 0.0;
    for (int k = 0; k < n; ++k) {
      for (int i = 0; i < 2; ++i) {
        du_[k][i] = std::clamp(from[k][i] + share * newton_[k][i], boundOf(k, i, Hold::kLower),
                               boundOf(k, i, Hold::kUpper));
        promised += thrust_gradient_[k][i] * (du_[k][i] - from[k][i]);
      }
    }
    const double moved = rollOutThrusts();
    if (moved <= cost + kSufficient * promised) {
      cost = moved;
      return true;
    }
  }
  return false;
}

double RtiSolver::stageCost(int k) const {
  double cost = costOf(state_costs_[k], dx_[k]);
  for (int i = 0; i < 2; ++i) {
    const InputCost& c = input_costs_[k];
    cost += (0.5 * c.weight[i] * du_[k][i] + c.gradient[i]) * du_[k][i];
  }
  return cost;
}

// The feedback of the last recursion with each thrust clipped on the way.
double RtiSolver::rollOutClipped(bool& clipped) {
  double cost = 0.0;
  clipped = false;
  for (int k = 0; k < options_.stages; ++k) {
    applyFeedback(feedbacks_[k], dx_[k], du_[k]);
    for (int i = 0; i < 2; ++i) {
      const double wanted = du_[k][i];
      du_[k][i] = std::clamp(wanted, boundOf(k, i, Hold::kLower), boundOf(k, i, Hold::kUpper));
      clipped |= std::abs(wanted - du_[k][i]) > kAtBoundN;
    }
    cost += stageCost(k);
    advance(linear_[k], dx_[k], du_[k], dx_[k + 1]);
  }
  return cost + costOf(state_costs_[options_.stages], dx_[options_.stages]);
}

// From the better of two starts, the feedback of the last recursion clipped and the plan as it is:
// the cost there.
double RtiSolver::startProjectedNewton() {
  const int n = options_.stages;
  bool clipped = false;
  const double stepped = rollOutClipped(clipped);
  std::copy(&du_[0][0], &du_[0][0] + 2 * n, &last_du_[0][0]);
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < 2; ++i) {
      du_[k][i] = std::clamp(0.0, boundOf(k, i, Hold::kLower), boundOf(k, i, Hold::kUpper));
    }
  }
  const double kept = rollOutThrusts();
  if (kept < stepped) {
    return kept;
  }
  std::copy(&last_du_[0][0], &last_du_[0][0] + 2 * n, &du_[0][0]);
  return rollOutThrusts();
}

SolverStatus RtiSolver::iterateProjectedNewton(const vessel::State& measured) {
  const int n = options_.stages;
  double cost = startProjectedNewton();
  bool clipped = true;
  for (int iteration = 0; iteration < options_.projected_newton_iterations; ++iteration) {
    ++iterations_;
    differentiateThrusts();
    int changed = holdPressed();
    if (!clipped && changed < 0) {
      return SolverStatus::kSolved;
    }
    changed = iteration == 0 ? n - 1 : changed;
    std::copy(&du_[0][0], &du_[0][0] + 2 * n, &last_du_[0][0]);
    if (!factor(changed, input_costs_)) {
      return SolverStatus::kIndefinite;
    }
    const double last_cost = cost;
    cost = rollOutClipped(clipped);
    if (cost < last_cost || (!clipped && cost <= last_cost + kRounding * std::abs(last_cost))) {
      continue;
    }
    clipped = true;
    cost = last_cost;
    rollOutPlan(measured);
    if (!moveWithin(last_du_, cost)) {
      break;
    }
  }
  return SolverStatus::kIterationsExhausted;
}

}  // namespace otter_nav::tracker
