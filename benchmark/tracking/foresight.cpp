#include "foresight.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "otter_nav/base/rk4.hpp"

namespace otter_nav::benchmark {
namespace {

using vessel::State;
using vessel::Thrusts;

// The least of 1/2 d'Hd + g'd within bounds, by trying each combination of held thrusters; `free`
// tells which ones are not at a bound.
Thrusts leastInBox(const Eigen::Matrix2d& h, const Thrusts& g, const Thrusts& lower,
                   const Thrusts& upper, bool (&free)[2]) {
  double least = std::numeric_limits<double>::infinity();
  Thrusts best = lower;
  for (int combination = 0; combination < 9; ++combination) {
    const int side[2] = {combination % 3, combination / 3};  // lower, upper, free
    Thrusts d;
    for (int i = 0; i < 2; ++i) {
      d[i] = side[i] == 0 ? lower[i] : upper[i];
    }
    if (side[0] == 2 && side[1] == 2) {
      d = -h.inverse() * g;
    } else if (side[0] == 2) {
      d[0] = -(g[0] + h(0, 1) * d[1]) / h(0, 0);
    } else if (side[1] == 2) {
      d[1] = -(g[1] + h(1, 0) * d[0]) / h(1, 1);
    }
    const bool inside =
        ((d - lower).array() >= -1e-9).all() && ((upper - d).array() >= -1e-9).all();
    const double cost = 0.5 * d.dot(h * d) + g.dot(d);
    if (inside && cost < least) {
      least = cost;
      best = d;
      free[0] = side[0] == 2;
      free[1] = side[1] == 2;
    }
  }
  return best;
}

}  // namespace

ForesightPlanner::ForesightPlanner(const Options& options, const vessel::Parameters& vessel)
    : options_(options), vessel_(vessel), stages_(static_cast<std::size_t>(options.stages)) {
  plan_.thrusts.assign(stages_.size(), Thrusts::Zero());
  plan_.states.assign(stages_.size() + 1, State::Zero());
}

State ForesightPlanner::advance(const State& x, const Thrusts& thrusts,
                                const vessel::Disturbance& disturbance) const {
  return rk4Step(
      [&](double, const State& y) {
        return vessel::stateDerivative(y, thrusts, vessel_.manoeuvring, vessel_.thrusters,
                                       disturbance);
      },
      0.0, x, options_.step_s);
}

State ForesightPlanner::stateWeight(int k) const {
  State w = State::Zero();
  w.head<2>().setConstant(options_.position_weight);
  w[vessel::kYawRate] = options_.yaw_rate_weight;
  return w * options_.step_s * (k == options_.stages ? options_.terminal_gain : 1.0);
}

State ForesightPlanner::stateSlope(const State& x, int k) const {
  State off = x;
  off.head<2>() -= (*positions_)[static_cast<std::size_t>(k)];
  return stateWeight(k).cwiseProduct(off);
}

void ForesightPlanner::linearize() {
  constexpr double kChange = 1e-5;
  constexpr double kThrustChange = 1e-3;
  for (std::size_t k = 0; k < stages_.size(); ++k) {
    const vessel::Disturbance& d = (*disturbances_)[k];
    const Thrusts& f = plan_.thrusts[k];
    for (int i = 0; i < 6; ++i) {
      const State h = kChange * State::Unit(i);
      stages_[k].by_state.col(i) =
          (advance(plan_.states[k] + h, f, d) - advance(plan_.states[k] - h, f, d)) /
          (2.0 * kChange);
    }
    for (int i = 0; i < 2; ++i) {
      const Thrusts h = kThrustChange * Thrusts::Unit(i);
      stages_[k].by_thrusts.col(i) =
          (advance(plan_.states[k], f + h, d) - advance(plan_.states[k], f - h, d)) /
          (2.0 * kThrustChange);
    }
  }
}

void ForesightPlanner::sweepBack(double damping) {
  const int n = options_.stages;
  vessel::StateJacobian v = stateWeight(n).asDiagonal();
  State slope = stateSlope(plan_.states.back(), n);
  const double r = options_.thrust_weight * options_.step_s;
  for (int k = n - 1; k >= 0; --k) {
    Stage& s = stages_[static_cast<std::size_t>(k)];
    const Thrusts& f = plan_.thrusts[static_cast<std::size_t>(k)];
    Eigen::Matrix2d h = s.by_thrusts.transpose() * v * s.by_thrusts;
    h.diagonal().array() += r + damping;
    const Eigen::Matrix<double, 2, 6> mixed = s.by_thrusts.transpose() * v * s.by_state;
    const Thrusts g = s.by_thrusts.transpose() * slope + r * f;
    const vessel::Thrusters& t = vessel_.thrusters;
    bool free[2] = {false, false};
    s.change = leastInBox(h, g, Thrusts::Constant(-t.astern_max_n) - f,
                          Thrusts::Constant(t.ahead_max_n) - f, free);
    s.gain.setZero();
    if (free[0] && free[1]) {
      s.gain = -h.inverse() * mixed;
    } else {
      for (int i = 0; i < 2; ++i) {
        if (free[i]) {
          s.gain.row(i) = -mixed.row(i) / h(i, i);
        }
      }
    }
    slope =
        (s.by_state.transpose() * slope + s.gain.transpose() * (h * s.change + g) +
         mixed.transpose() * s.change + stateSlope(plan_.states[static_cast<std::size_t>(k)], k))
            .eval();
    v = (s.by_state.transpose() * v * s.by_state + s.gain.transpose() * h * s.gain +
         s.gain.transpose() * mixed + mixed.transpose() * s.gain)
            .eval();
    v = (0.5 * (v + v.transpose())).eval();
    v.diagonal() += stateWeight(k);
  }
}

ForesightPlanner::Plan ForesightPlanner::rollOut(const State& start, double share) const {
  Plan p;
  p.states.push_back(start);
  const auto costOf = [&](int k) {
    State off = p.states.back();
    off.head<2>() -= (*positions_)[static_cast<std::size_t>(k)];
    return 0.5 * stateWeight(k).dot(off.cwiseAbs2());
  };
  for (int k = 0; k < options_.stages; ++k) {
    const auto i = static_cast<std::size_t>(k);
    p.cost += costOf(k);
    const Stage& s = stages_[i];
    const Thrusts wanted =
        plan_.thrusts[i] + share * s.change + s.gain * (p.states.back() - plan_.states[i]);
    p.thrusts.emplace_back(
        wanted.cwiseMin(vessel_.thrusters.ahead_max_n).cwiseMax(-vessel_.thrusters.astern_max_n));
    p.cost += 0.5 * options_.thrust_weight * options_.step_s * p.thrusts.back().squaredNorm();
    p.states.push_back(advance(p.states.back(), p.thrusts.back(), (*disturbances_)[i]));
  }
  p.cost += costOf(options_.stages);
  return p;
}

bool ForesightPlanner::improve(const State& start) {
  linearize();
  for (double damping = 1e-9; damping < 1e-1; damping = std::max(10.0 * damping, 1e-6)) {
    sweepBack(damping);
    for (const double share : {1.0, 0.5, 0.25, 0.1, 0.03}) {
      Plan next = rollOut(start, share);
      if (next.cost < plan_.cost) {
        const bool goes_on = plan_.cost - next.cost > 1e-5 * plan_.cost;
        plan_ = std::move(next);
        return goes_on;
      }
    }
  }
  return false;
}

Thrusts ForesightPlanner::plan(const State& start, const std::vector<Eigen::Vector2d>& positions,
                               const std::vector<vessel::Disturbance>& disturbances) {
  positions_ = &positions;
  disturbances_ = &disturbances;
  std::rotate(plan_.thrusts.begin(), plan_.thrusts.begin() + 1, plan_.thrusts.end());
  plan_.thrusts.back() = plan_.thrusts[plan_.thrusts.size() - 2];
  for (Stage& s : stages_) {
    s.change.setZero();
    s.gain.setZero();
  }
  plan_ = rollOut(start, 0.0);
  for (int i = 0; i < options_.iterations && improve(start); ++i) {
  }
  return plan_.thrusts.front();
}

}  // namespace otter_nav::benchmark
