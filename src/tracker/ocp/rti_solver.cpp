#include "tracker/ocp/rti_solver.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::tracker {

double nearness(const vessel::State& x, const vessel::State& reference, double far_m) {
  return 1.0 / std::sqrt(1.0 + (x - reference).head<2>().squaredNorm() / (far_m * far_m));
}

RtiSolver::RtiSolver(const OcpOptions& options, const vessel::ManoeuvringModel& model,
                     const vessel::Thrusters& thrusters)
    : options_(options), model_(model, thrusters) {
  states_.fill(vessel::State::Zero());
  thrusts_.fill(vessel::Thrusts::Zero());
  for (auto& hold : hold_) {
    hold[0] = hold[1] = Hold::kFree;
  }
  lower_.fill(options.lower_n);
  upper_.fill(options.upper_n);
}

void RtiSolver::limitRates(const vessel::Thrusts& acting, double rate_nps) {
  for (int k = 0; k < options_.stages; ++k) {
    const double reach = (k + 0.5) * options_.step_s * rate_nps;
    lower_[k] = options_.lower_n.cwiseMax((acting.array() - reach).matrix());
    upper_[k] = options_.upper_n.cwiseMin((acting.array() + reach).matrix());
  }
}

void RtiSolver::setDisturbance(const vessel::Disturbance& disturbance) {
  model_.setDisturbance(disturbance);
}

void RtiSolver::initialize(const OcpReference& reference) {
  const int n = options_.stages;
  for (int k = 0; k <= n; ++k) {
    states_[k] = reference.states[k];
  }
  for (int k = 0; k < n; ++k) {
    thrusts_[k] = reference.thrusts[k].cwiseMax(lower_[k]).cwiseMin(upper_[k]);
    hold_[k][0] = hold_[k][1] = Hold::kFree;
  }
  prepared_ = SolverStatus::kNotFinite;
}

void RtiSolver::shift(double fraction) {
  const int n = options_.stages;
  const double f = std::clamp(fraction, 0.0, 1.0);
  for (int k = 0; k + 1 < n; ++k) {
    states_[k] += f * (states_[k + 1] - states_[k]);
    thrusts_[k] += f * (thrusts_[k + 1] - thrusts_[k]);
  }
  const vessel::State last = states_[n] - states_[n - 1];
  states_[n - 1] += f * last;
  states_[n] += f * last;
}

void RtiSolver::setCosts(const OcpReference& reference) {
  const int n = options_.stages;
  for (int k = 0; k <= n; ++k) {
    vessel::State w = k == n ? options_.weights.terminal : options_.weights.state;
    w.segment<3>(vessel::kPsi) *= reference.attitude[k];
    w.head<2>() *= nearness(states_[k], reference.states[k], options_.far_m);
    const vessel::State g = w.cwiseProduct(states_[k] - reference.states[k]);
    StateCost& cost = state_costs_[k];
    cost.weight_q = Pack{w[2], w[3], w[4], w[5]};
    cost.gradient_q = Pack{g[2], g[3], g[4], g[5]};
    for (int i = 0; i < 2; ++i) {
      cost.weight_p[i] = w[i];
      cost.gradient_p[i] = g[i];
    }
  }
  const vessel::Thrusts& w = options_.weights.thrusts;
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < 2; ++i) {
      input_costs_[k].weight[i] = w[i] + options_.regularization;
      input_costs_[k].gradient[i] = w[i] * (thrusts_[k][i] - reference.thrusts[k][i]);
    }
  }
}

bool RtiSolver::factor(int from, const std::array<InputCost, kMaxStages>& costs) {
  bool definite = true;
  for (int k = from; k >= 0; --k) {
    double held[2] = {0.0, 0.0};
    for (int i = 0; i < 2; ++i) {
      if (hold_[k][i] != Hold::kFree) {
        held[i] = boundOf(k, i, hold_[k][i]);
      }
    }
    definite &= riccatiStep(linear_[k], state_costs_[k], costs[k], hold_[k], held, values_[k + 1],
                            values_[k], feedbacks_[k]);
  }
  return definite;
}

SolverStatus RtiSolver::prepare(const OcpReference& reference) {
  const int n = options_.stages;
  model_.linearize(states_.data(), thrusts_.data(), n, options_.step_s, linear_.data());
  setCosts(reference);
  terminalValue(state_costs_[n], values_[n]);
  prepared_ = factor(n - 1, input_costs_) ? SolverStatus::kSolved : SolverStatus::kIndefinite;
  return prepared_;
}

void RtiSolver::rollOutPlan(const vessel::State& measured) {
  for (int row = 0; row < 6; ++row) {
    dx_[0][row] = measured[row] - states_[0][row];
  }
  for (int k = 0; k < options_.stages; ++k) {
    applyFeedback(feedbacks_[k], dx_[k], du_[k]);
    advance(linear_[k], dx_[k], du_[k], dx_[k + 1]);
  }
}

int RtiSolver::reviseHolds() {
  constexpr double kTolerance = 1e-9;
  int highest = -1;
  for (int k = 0; k < options_.stages; ++k) {
    for (int i = 0; i < 2; ++i) {
      Hold next = hold_[k][i];
      if (next == Hold::kFree) {
        const double thrust = thrusts_[k][i] + du_[k][i];
        if (thrust < lower_[k][i] - kTolerance) {
          next = Hold::kLower;
        } else if (thrust > upper_[k][i] + kTolerance) {
          next = Hold::kUpper;
        }
      } else {
        const Feedback& f = feedbacks_[k];
        const Deviation& dx = dx_[k];
        const double gradient = f.hessian[i][0] * du_[k][0] + f.hessian[i][1] * du_[k][1] +
                                f.g_p[i][0] * dx[0] + f.g_p[i][1] * dx[1] + f.g_q[i][0] * dx[2] +
                                f.g_q[i][1] * dx[3] + f.g_q[i][2] * dx[4] + f.g_q[i][3] * dx[5] +
                                f.h[i];
        if (next == Hold::kLower ? gradient < -kTolerance : gradient > kTolerance) {
          next = Hold::kFree;
        }
      }
      if (next != hold_[k][i]) {
        hold_[k][i] = next;
        highest = k;
      }
    }
  }
  return highest;
}

SolverStatus RtiSolver::iterateActiveSet(const vessel::State& measured) {
  rollOutPlan(measured);
  int changed = reviseHolds();
  while (changed >= 0 && iterations_ < options_.active_set_iterations) {
    ++iterations_;
    if (!factor(changed, input_costs_)) {
      return SolverStatus::kIndefinite;
    }
    rollOutPlan(measured);
    changed = reviseHolds();
  }
  return changed < 0 ? SolverStatus::kSolved : SolverStatus::kIterationsExhausted;
}

SolverStatus RtiSolver::feedback(const vessel::State& measured) {
  iterations_ = 0;
  if (prepared_ != SolverStatus::kSolved) {
    return prepared_;
  }
  if (!measured.allFinite()) {
    return SolverStatus::kNotFinite;
  }
  SolverStatus status = iterateActiveSet(measured);
  if (status == SolverStatus::kIterationsExhausted) {
    status = iterateProjectedNewton(measured);
  }
  if (status == SolverStatus::kIterationsExhausted) {
    status = iterateInteriorPoint(measured);
  }
  prepared_ = SolverStatus::kNotFinite;  // a preparation serves one feedback
  if (!usable(status)) {
    return status;
  }
  if (!finite()) {
    for (auto& hold : hold_) {
      hold[0] = hold[1] = Hold::kFree;
    }
    return SolverStatus::kNotFinite;
  }
  accept();
  return status;
}

bool RtiSolver::finite() const {
  double sum = 0.0;
  for (int k = 0; k < options_.stages; ++k) {
    sum += std::abs(du_[k][0]) + std::abs(du_[k][1]);
  }
  for (double d : dx_[options_.stages]) {
    sum += std::abs(d);
  }
  return std::isfinite(sum);
}

void RtiSolver::accept() {
  const int n = options_.stages;
  const vessel::Thrusts range = options_.upper_n - options_.lower_n;
  last_step_ = 0.0;
  double turn = 0.0;
  for (int k = 0; k <= n; ++k) {
    turn = std::max(turn, std::abs(dx_[k][vessel::kPsi]));
  }
  const double share =
      std::min(options_.step_share, options_.heading_step_rad / std::max(turn, 1e-9));
  for (int k = 0; k <= n; ++k) {
    states_[k] += share * Eigen::Map<const vessel::State>(dx_[k]);
  }
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < 2; ++i) {
      last_step_ = std::max(last_step_, std::abs(du_[k][i]) / range[i]);
      thrusts_[k][i] = std::clamp(thrusts_[k][i] + share * du_[k][i], lower_[k][i], upper_[k][i]);
    }
  }
}

}  // namespace otter_nav::tracker
