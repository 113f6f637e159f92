#include "tracker/ocp/rti_solver.hpp"

#include <algorithm>
#include <cmath>

#include "tracker/qp/active_set.hpp"
#include "tracker/qp/interior_point.hpp"
#include "tracker/qp/projected_newton.hpp"

namespace otter_nav::tracker {

RtiSolver::RtiSolver(const OcpOptions& problem, const RtiOptions& options,
                     const vessel::ManoeuvringModel& model, const vessel::Thrusters& thrusters)
    : options_(options),
      problem_(problem),
      model_(model, thrusters, options.finite_turn_rad),
      qp_(problem.stages) {
  // A strategy is a class of the folder qp/ and a line here.
  strategies_.push_back(std::make_unique<qp::ActiveSet>(options.active_set_iterations));
  strategies_.push_back(std::make_unique<qp::ProjectedNewton>(options.projected_newton_iterations));
  strategies_.push_back(std::make_unique<qp::InteriorPoint>(options.interior_point_iterations));
  plan_.states.fill(vessel::State::Zero());
  plan_.thrusts.fill(vessel::Thrusts::Zero());
}

void RtiSolver::setDisturbance(const vessel::Disturbance& disturbance) {
  model_.setDisturbance(disturbance);
}

void RtiSolver::limitRates(const vessel::Thrusts& acting, double rate_nps) {
  problem_.limitRates(acting, rate_nps);
}

void RtiSolver::initialize(const OcpReference& reference) {
  for (int k = 0; k <= qp_.stages(); ++k) {
    plan_.states[k] = reference.states[k];
  }
  for (int k = 0; k < qp_.stages(); ++k) {
    plan_.thrusts[k] = problem_.clampToBounds(k, reference.thrusts[k]);
  }
  qp_.freeAll();
  prepared_ = SolverStatus::kNotFinite;
}

void RtiSolver::initializeAtRest(const OcpReference& reference) {
  initialize(reference);
  for (int k = 0; k <= qp_.stages(); ++k) {
    plan_.states[k].tail<3>().setZero();
  }
}

void RtiSolver::shift(double fraction) {
  const int n = qp_.stages();
  const double f = std::clamp(fraction, 0.0, 1.0);
  for (int k = 0; k + 1 < n; ++k) {
    plan_.states[k] += f * (plan_.states[k + 1] - plan_.states[k]);
    plan_.thrusts[k] += f * (plan_.thrusts[k + 1] - plan_.thrusts[k]);
  }
  const vessel::State last = plan_.states[n] - plan_.states[n - 1];
  plan_.states[n - 1] += f * last;
  plan_.states[n] += f * last;
}

SolverStatus RtiSolver::prepare(const OcpReference& reference) {
  model_.linearize(plan_.states.data(), plan_.thrusts.data(), qp_.stages(),
                   problem_.options().step_s, qp_.linear.data());
  problem_.expand(plan_, reference, qp_);
  prepared_ = qp_.factor() ? SolverStatus::kSolved : SolverStatus::kIndefinite;
  return prepared_;
}

SolverStatus RtiSolver::solve() {
  SolverStatus status = SolverStatus::kIterationsExhausted;
  iterations_ = 0;
  for (std::size_t i = 0; status == SolverStatus::kIterationsExhausted && i < strategies_.size();
       ++i) {
    const qp::Outcome outcome = strategies_[i]->solve(qp_);
    iterations_ += outcome.iterations;
    status = outcome.status;
  }
  return status;
}

SolverStatus RtiSolver::feedback(const vessel::State& measured) {
  iterations_ = 0;
  if (prepared_ != SolverStatus::kSolved) {
    return prepared_;
  }
  if (!measured.allFinite()) {
    return SolverStatus::kNotFinite;
  }
  for (int row = 0; row < 6; ++row) {
    qp_.dx[0][row] = measured[row] - plan_.states[0][row];
  }
  const SolverStatus status = solve();
  prepared_ = SolverStatus::kNotFinite;  // a preparation serves one feedback
  if (!usable(status)) {
    return status;
  }
  if (!finite()) {
    qp_.freeAll();
    return SolverStatus::kNotFinite;
  }
  accept();
  return status;
}

bool RtiSolver::finite() const {
  double sum = 0.0;
  for (int k = 0; k < qp_.stages(); ++k) {
    sum += std::abs(qp_.du[k][0]) + std::abs(qp_.du[k][1]);
  }
  for (double d : qp_.dx[qp_.stages()]) {
    sum += std::abs(d);
  }
  return std::isfinite(sum);
}

void RtiSolver::accept() {
  const int n = qp_.stages();
  double turn = 0.0;
  for (int k = 0; k <= n; ++k) {
    turn = std::max(turn, std::abs(qp_.dx[k][vessel::kPsi]));
  }
  const double share =
      std::min(options_.step_share, options_.heading_step_rad / std::max(turn, 1e-9));
  for (int k = 0; k <= n; ++k) {
    plan_.states[k] += share * Eigen::Map<const vessel::State>(qp_.dx[k]);
  }
  for (int k = 0; k < n; ++k) {
    const Eigen::Map<const vessel::Thrusts> du(qp_.du[k]);
    plan_.thrusts[k] = problem_.clampToBounds(k, plan_.thrusts[k] + share * du);
  }
}

}  // namespace otter_nav::tracker
