#include "tracker/qp/box_qp.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::tracker::qp {
namespace {

constexpr double kTolerance = 1e-9;  // of a bound in N, of a multiplier in its own units

double dot(Pack a, Pack b) {
  const Pack p = a * b;
  return (p[0] + p[1]) + (p[2] + p[3]);
}

double costOf(const StateCost& c, const Deviation& dx) {
  const Pack q = Pack{dx[2], dx[3], dx[4], dx[5]};
  double cost = dot(0.5 * c.weight_q * q + c.gradient_q, q);
  for (int i = 0; i < 2; ++i) {
    cost += (0.5 * c.weight_p[i] * dx[i] + c.gradient_p[i]) * dx[i];
  }
  return cost;
}

}  // namespace

BoxQp::BoxQp(int stages) : stages_(stages) {
  freeAll();
}

void BoxQp::freeAll() {
  std::fill(&hold[0][0], &hold[0][0] + 2 * kMaxStages, Hold::kFree);
}

double BoxQp::clampToBounds(int stage, int thruster, double value) const {
  return std::clamp(value, lower[stage][thruster], upper[stage][thruster]);
}

bool BoxQp::factor(int from, const InputCosts& inputs) {
  bool definite = true;
  for (int k = from; k >= 0; --k) {
    double held[2] = {0.0, 0.0};
    for (int i = 0; i < 2; ++i) {
      if (hold[k][i] != Hold::kFree) {
        held[i] = bound(k, i, hold[k][i]);
      }
    }
    definite &= riccatiStep(linear[k], state_costs[k], inputs[k], hold[k], held, values_[k + 1],
                            values_[k], feedbacks_[k]);
  }
  return definite;
}

bool BoxQp::factor() {
  terminalValue(state_costs[stages_], values_[stages_]);
  return factor(stages_ - 1);
}

void BoxQp::updateGradients(const InputCosts& inputs) {
  for (int k = stages_ - 1; k >= 0; --k) {
    updateGradient(linear[k], state_costs[k], inputs[k], values_[k + 1], values_[k], feedbacks_[k]);
  }
}

void BoxQp::rollOut() {
  for (int k = 0; k < stages_; ++k) {
    applyFeedback(feedbacks_[k], dx[k], du[k]);
    advance(linear[k], dx[k], du[k], dx[k + 1]);
  }
}

double BoxQp::rollOutClipped(bool& clipped) {
  double cost = 0.0;
  clipped = false;
  for (int k = 0; k < stages_; ++k) {
    applyFeedback(feedbacks_[k], dx[k], du[k]);
    for (int i = 0; i < 2; ++i) {
      const double wanted = du[k][i];
      du[k][i] = clampToBounds(k, i, wanted);
      clipped |= std::abs(wanted - du[k][i]) > kTolerance;
    }
    cost += stageCost(k);
    advance(linear[k], dx[k], du[k], dx[k + 1]);
  }
  return cost + costOf(state_costs[stages_], dx[stages_]);
}

double BoxQp::rollOutInputs() {
  double cost = 0.0;
  for (int k = 0; k < stages_; ++k) {
    cost += stageCost(k);
    advance(linear[k], dx[k], du[k], dx[k + 1]);
  }
  return cost + costOf(state_costs[stages_], dx[stages_]);
}

double BoxQp::stageCost(int k) const {
  double cost = costOf(state_costs[k], dx[k]);
  for (int i = 0; i < 2; ++i) {
    const InputCost& c = input_costs[k];
    cost += (0.5 * c.weight[i] * du[k][i] + c.gradient[i]) * du[k][i];
  }
  return cost;
}

int BoxQp::reviseHolds() {
  int highest = -1;
  for (int k = 0; k < stages_; ++k) {
    for (int i = 0; i < 2; ++i) {
      Hold next = hold[k][i];
      if (next == Hold::kFree) {
        if (du[k][i] < lower[k][i] - kTolerance) {
          next = Hold::kLower;
        } else if (du[k][i] > upper[k][i] + kTolerance) {
          next = Hold::kUpper;
        }
      } else {
        const Feedback& f = feedbacks_[k];
        const Deviation& d = dx[k];
        const double gradient = f.hessian[i][0] * du[k][0] + f.hessian[i][1] * du[k][1] +
                                f.g_p[i][0] * d[0] + f.g_p[i][1] * d[1] + f.g_q[i][0] * d[2] +
                                f.g_q[i][1] * d[3] + f.g_q[i][2] * d[4] + f.g_q[i][3] * d[5] +
                                f.h[i];
        if (next == Hold::kLower ? gradient < -kTolerance : gradient > kTolerance) {
          next = Hold::kFree;
        }
      }
      if (next != hold[k][i]) {
        hold[k][i] = next;
        highest = k;
      }
    }
  }
  return highest;
}

}  // namespace otter_nav::tracker::qp
