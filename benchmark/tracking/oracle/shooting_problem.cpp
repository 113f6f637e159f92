#include "tracking/oracle/shooting_problem.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/rk4.hpp"

namespace otter_nav::tracker {

using vessel::InputJacobian;
using vessel::State;
using vessel::StateJacobian;
using vessel::Thrusts;

ShootingProblem::ShootingProblem(const OcpOptions& options, const vessel::ManoeuvringModel& model,
                                 const vessel::Thrusters& thrusters)
    : options_(options), model_(model), thrusters_(thrusters) {}

void ShootingProblem::set(const State& measured, const OcpReference& reference,
                          const vessel::Disturbance& disturbance, const IpoptSolution* warm) {
  measured_ = measured;
  reference_ = reference;
  disturbance_ = disturbance;
  warm_ = warm;
}

State ShootingProblem::stateAt(const Number* x, int k) const {
  return Eigen::Map<const State>(x + 6 * k);
}

Thrusts ShootingProblem::thrustsAt(const Number* x, int k) const {
  return Eigen::Map<const Thrusts>(x + thrustIndex(k));
}

State ShootingProblem::weight(int k) const {
  return stateWeights(options_, reference_, k);
}

ShootingProblem::Step ShootingProblem::step(const State& x, const Thrusts& thrusts) const {
  const double h = options_.step_s;
  const double nodes[4] = {0.0, 0.5 * h, 0.5 * h, h};
  const double weights[4] = {h / 6.0, h / 3.0, h / 3.0, h / 6.0};
  Step s{x, StateJacobian::Identity(), InputJacobian::Zero()};
  State rate = State::Zero();
  StateJacobian rate_by_state = StateJacobian::Zero();
  InputJacobian rate_by_thrusts = InputJacobian::Zero();
  for (int i = 0; i < 4; ++i) {
    const vessel::Linearization l =
        vessel::linearize(x + nodes[i] * rate, thrusts, model_, thrusters_, disturbance_);
    rate_by_thrusts = (l.state_jacobian * (nodes[i] * rate_by_thrusts) + l.input_jacobian).eval();
    rate_by_state =
        (l.state_jacobian * (StateJacobian::Identity() + nodes[i] * rate_by_state)).eval();
    rate = l.derivative;
    s.end += weights[i] * rate;
    s.by_state += weights[i] * rate_by_state;
    s.by_thrusts += weights[i] * rate_by_thrusts;
  }
  return s;
}

bool ShootingProblem::get_nlp_info(Index& n, Index& m, Index& jacobian_entries,
                                   Index& hessian_entries, IndexStyleEnum& style) {
  n = 6 * (options_.stages + 1) + 2 * options_.stages;
  m = 6 * options_.stages;
  jacobian_entries = options_.stages * (36 + 12 + 6);
  hessian_entries = n;
  style = C_STYLE;
  return true;
}

bool ShootingProblem::get_bounds_info(Index n, Number* lower, Number* upper, Index m,
                                      Number* g_lower, Number* g_upper) {
  std::fill(lower, lower + n, -1e19);
  std::fill(upper, upper + n, 1e19);
  Eigen::Map<State>{lower} = measured_;
  Eigen::Map<State>{upper} = measured_;
  for (int k = 0; k < options_.stages; ++k) {
    Eigen::Map<Thrusts>(lower + thrustIndex(k)) = options_.lower_n;
    Eigen::Map<Thrusts>(upper + thrustIndex(k)) = options_.upper_n;
  }
  std::fill(g_lower, g_lower + m, 0.0);
  std::fill(g_upper, g_upper + m, 0.0);
  return true;
}

bool ShootingProblem::get_starting_point(Index /*n*/, bool /*init_x*/, Number* x, bool init_z,
                                         Number* /*z_lower*/, Number* /*z_upper*/, Index /*m*/,
                                         bool init_lambda, Number* /*lambda*/) {
  for (int k = 0; k <= options_.stages; ++k) {
    Eigen::Map<State>(x + 6 * k) =
        warm_ != nullptr ? warm_->states[static_cast<std::size_t>(k)] : reference_.states[k];
  }
  for (int k = 0; k < options_.stages; ++k) {
    Eigen::Map<Thrusts>(x + thrustIndex(k)) =
        warm_ != nullptr ? warm_->thrusts[static_cast<std::size_t>(k)] : reference_.thrusts[k];
  }
  return !init_z && !init_lambda;
}

bool ShootingProblem::eval_f(Index /*n*/, const Number* x, bool /*fresh*/, Number& value) {
  value = 0.0;
  for (int k = 0; k <= options_.stages; ++k) {
    const State off = stateAt(x, k) - reference_.states[k];
    const State w = weight(k);
    const double far = options_.far_m;
    value += 0.5 * w.tail<4>().dot(off.tail<4>().cwiseAbs2()) +
             w[0] * far * far * (std::hypot(1.0, off.head<2>().norm() / far) - 1.0);
  }
  for (int k = 0; k < options_.stages; ++k) {
    value +=
        0.5 * options_.weights.thrusts.dot((thrustsAt(x, k) - reference_.thrusts[k]).cwiseAbs2());
  }
  return true;
}

bool ShootingProblem::eval_grad_f(Index /*n*/, const Number* x, bool /*fresh*/, Number* gradient) {
  for (int k = 0; k <= options_.stages; ++k) {
    const State off = stateAt(x, k) - reference_.states[k];
    Eigen::Map<State> part(gradient + 6 * k);
    part = weight(k).cwiseProduct(off);
    part.head<2>() /= std::hypot(1.0, off.head<2>().norm() / options_.far_m);
  }
  for (int k = 0; k < options_.stages; ++k) {
    Eigen::Map<Thrusts>(gradient + thrustIndex(k)) =
        options_.weights.thrusts.cwiseProduct(thrustsAt(x, k) - reference_.thrusts[k]);
  }
  return true;
}

bool ShootingProblem::eval_g(Index /*n*/, const Number* x, bool /*fresh*/, Index /*m*/, Number* g) {
  for (int k = 0; k < options_.stages; ++k) {
    const Thrusts thrusts = thrustsAt(x, k);
    const State end = rk4Step(
        [&](double, const State& y) {
          return vessel::stateDerivative(y, thrusts, model_, thrusters_, disturbance_);
        },
        0.0, stateAt(x, k), options_.step_s);
    Eigen::Map<State>(g + 6 * k) = stateAt(x, k + 1) - end;
  }
  return true;
}

bool ShootingProblem::eval_jac_g(Index /*n*/, const Number* x, bool /*fresh*/, Index /*m*/,
                                 Index /*entries*/, Index* rows, Index* columns, Number* values) {
  Index at = 0;
  const auto add = [&](Index row, Index column, double value) {
    if (values == nullptr) {
      rows[at] = row;
      columns[at] = column;
    } else {
      values[at] = value;
    }
    ++at;
  };
  for (int k = 0; k < options_.stages; ++k) {
    const Step s = values == nullptr ? Step{} : step(stateAt(x, k), thrustsAt(x, k));
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 6; ++column) {
        add(6 * k + row, 6 * k + column, -s.by_state(row, column));
      }
      for (int column = 0; column < 2; ++column) {
        add(6 * k + row, thrustIndex(k) + column, -s.by_thrusts(row, column));
      }
      add(6 * k + row, 6 * (k + 1) + row, 1.0);
    }
  }
  return true;
}

// Gauss and Newton: the curvature of the constraints is left out, which changes the way to the
// solution and not the solution.
bool ShootingProblem::eval_h(Index n, const Number* /*x*/, bool /*fresh*/, Number factor,
                             Index /*m*/, const Number* /*lambda*/, bool /*fresh_lambda*/,
                             Index /*entries*/, Index* rows, Index* columns, Number* values) {
  for (Index i = 0; i < n; ++i) {
    if (values == nullptr) {
      rows[i] = columns[i] = i;
    } else {
      const bool is_state = i < thrustIndex(0);
      values[i] = factor * (is_state ? weight(i / 6)[i % 6]
                                     : options_.weights.thrusts[(i - thrustIndex(0)) % 2]);
    }
  }
  return true;
}

void ShootingProblem::finalize_solution(Ipopt::SolverReturn /*status*/, Index /*n*/,
                                        const Number* x, const Number* /*z_lower*/,
                                        const Number* /*z_upper*/, Index /*m*/, const Number* /*g*/,
                                        const Number* /*lambda*/, Number /*value*/,
                                        const Ipopt::IpoptData* /*data*/,
                                        Ipopt::IpoptCalculatedQuantities* /*quantities*/) {
  solution_.states.clear();
  solution_.thrusts.clear();
  for (int k = 0; k <= options_.stages; ++k) {
    solution_.states.push_back(stateAt(x, k));
  }
  for (int k = 0; k < options_.stages; ++k) {
    solution_.thrusts.push_back(thrustsAt(x, k));
  }
}

}  // namespace otter_nav::tracker
