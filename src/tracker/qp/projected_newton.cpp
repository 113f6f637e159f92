#include "tracker/qp/projected_newton.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::tracker::qp {
namespace {

constexpr double kAtBoundN = 1e-9;
constexpr double kShortestShare = 1.0 / 64.0;
constexpr double kRounding = 1e-12;
constexpr double kSufficient = 1e-4;  // of the decrease the gradient promises

}  // namespace

void ProjectedNewton::keep(const BoxQp& qp) {
  std::copy(&qp.du[0][0], &qp.du[0][0] + 2 * qp.stages(), &last_du_[0][0]);
}

// By the adjoint recursion, at dx and du.
void ProjectedNewton::differentiate(const BoxQp& qp) {
  const int n = qp.stages();
  const auto slope = [&](int k, Pack& q, double(&p)[2]) {
    const StateCost& c = qp.state_costs[k];
    const Deviation& dx = qp.dx[k];
    q = c.weight_q * Pack{dx[2], dx[3], dx[4], dx[5]} + c.gradient_q;
    for (int i = 0; i < 2; ++i) {
      p[i] = c.weight_p[i] * dx[i] + c.gradient_p[i];
    }
  };
  Pack q;
  double p[2];
  slope(n, q, p);
  for (int k = n - 1; k >= 0; --k) {
    const Stage& s = qp.linear[k];
    const double adjoint[6] = {p[0], p[1], q[0], q[1], q[2], q[3]};
    const auto [back, input_part] = throughStage(s, adjoint);
    for (int i = 0; i < 2; ++i) {
      const InputCost& c = qp.input_costs[k];
      gradient_[k][i] = c.weight[i] * qp.du[k][i] + c.gradient[i] + input_part[i];
    }
    slope(k, q, p);
    q += back;
    p[0] += adjoint[0];
    p[1] += adjoint[1];
  }
}

int ProjectedNewton::holdPressed(BoxQp& qp) {
  int highest = -1;
  for (int k = 0; k < qp.stages(); ++k) {
    for (int i = 0; i < 2; ++i) {
      const double gradient = gradient_[k][i];
      const bool low = qp.du[k][i] <= qp.lower[k][i] + kAtBoundN;
      const bool high = qp.du[k][i] >= qp.upper[k][i] - kAtBoundN;
      Hold& hold = qp.hold[k][i];
      hold = low && gradient > 0.0    ? Hold::kLower
             : high && gradient < 0.0 ? Hold::kUpper
                                      : Hold::kFree;
      if (hold != factored_[k][i]) {
        factored_[k][i] = hold;
        highest = k;
      }
    }
  }
  return highest;
}

bool ProjectedNewton::moveWithin(BoxQp& qp, double& cost) {
  const int n = qp.stages();
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < 2; ++i) {
      newton_[k][i] = qp.du[k][i] - last_du_[k][i];
    }
  }
  for (double share = 1.0; share >= kShortestShare; share *= 0.5) {
    double promised = 0.0;
    for (int k = 0; k < n; ++k) {
      for (int i = 0; i < 2; ++i) {
        qp.du[k][i] = qp.clampToBounds(k, i, last_du_[k][i] + share * newton_[k][i]);
        promised += gradient_[k][i] * (qp.du[k][i] - last_du_[k][i]);
      }
    }
    const double moved = qp.rollOutInputs();
    if (moved <= cost + kSufficient * promised) {
      cost = moved;
      return true;
    }
  }
  return false;
}

double ProjectedNewton::start(BoxQp& qp) {
  bool clipped = false;
  const double stepped = qp.rollOutClipped(clipped);
  keep(qp);
  for (int k = 0; k < qp.stages(); ++k) {
    for (int i = 0; i < 2; ++i) {
      qp.du[k][i] = qp.clampToBounds(k, i, 0.0);
    }
  }
  const double kept = qp.rollOutInputs();
  if (kept < stepped) {
    return kept;
  }
  std::copy(&last_du_[0][0], &last_du_[0][0] + 2 * qp.stages(), &qp.du[0][0]);
  return qp.rollOutInputs();
}

Outcome ProjectedNewton::solve(BoxQp& qp) {
  Outcome outcome;
  double cost = start(qp);
  bool clipped = true;
  while (outcome.iterations < iterations_) {
    const bool first = outcome.iterations++ == 0;
    differentiate(qp);
    const int changed = holdPressed(qp);
    if (!clipped && changed < 0) {
      return outcome;
    }
    keep(qp);
    if (!qp.factor(first ? qp.stages() - 1 : changed)) {
      outcome.status = SolverStatus::kIndefinite;
      return outcome;
    }
    const double last_cost = cost;
    cost = qp.rollOutClipped(clipped);
    if (cost < last_cost || (!clipped && cost <= last_cost + kRounding * std::abs(last_cost))) {
      continue;
    }
    clipped = true;
    cost = last_cost;
    qp.rollOut();
    if (!moveWithin(qp, cost)) {
      break;
    }
  }
  outcome.status = SolverStatus::kIterationsExhausted;
  return outcome;
}

}  // namespace otter_nav::tracker::qp
