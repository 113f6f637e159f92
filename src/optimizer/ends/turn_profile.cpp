#include "optimizer/ends/turn_profile.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::optimizer {
namespace {

constexpr int kPeakHalvings = 60;
// Without a moment the yaw rate shall die away in no more than this.
constexpr double kLooseLagS = 0.6;

double slowDown(double up_s, double lag_s) {
  return lag_s * std::log(2.0 - std::exp(-up_s / lag_s));
}

// The least argument in [0, high] at which the rising `reach` is `wanted`.
template <typename Function>
double solveRising(double high, double wanted, const Function& reach) {
  double low = 0.0;
  double middle = 0.0;
  for (int i = 0; i < kPeakHalvings; ++i) {
    middle = 0.5 * (low + high);
    (reach(middle) < wanted ? low : high) = middle;
  }
  return middle;
}

}  // namespace

TurnProfile::Reached TurnProfile::after(const Phase& phase, double t_s) const {
  const double excess = phase.reached.r - phase.r_target;
  const double decay = std::exp(-t_s / lag_s_);
  const double gone = lag_s_ * (1.0 - decay);
  Reached now;
  now.r = phase.r_target + excess * decay;
  now.r1 = -excess * decay / lag_s_;
  now.psi = phase.reached.psi + phase.r_target * t_s + excess * gone;
  now.integral = phase.reached.integral + phase.reached.psi * t_s +
                 0.5 * phase.r_target * t_s * t_s + excess * lag_s_ * (t_s - gone);
  return now;
}

void TurnProfile::append(double r_from, double r_target, double duration_s) {
  reached_.r = r_from;
  phases_.push_back({end_s_, reached_, r_target});
  reached_ = after(phases_.back(), duration_s);
  end_s_ += duration_s;
}

void TurnProfile::finish(double r_from) {
  reached_.r = r_from;
  phases_.push_back({end_s_, reached_, 0.0});
}

TurnProfile::Reached TurnProfile::reachedAt(double t_s, double within_s) const {
  if (within_s < 0.0) {
    return {};
  }
  std::size_t k = phases_.size() - 1;
  while (k > 0 && phases_[k].start_s > within_s) {
    --k;
  }
  return after(phases_[k], t_s - phases_[k].start_s);
}

Eigen::Vector4d TurnProfile::at(double t_s, double within_s) const {
  const Reached now = reachedAt(t_s, within_s);
  const Reached before = reachedAt(t_s - ramp_s_, within_s - ramp_s_);
  return Eigen::Vector4d(now.integral - before.integral, now.psi - before.psi, now.r - before.r,
                         now.r1 - before.r1) /
         ramp_s_;
}

std::vector<double> TurnProfile::joints() const {
  std::vector<double> times;
  for (const Phase& phase : phases_) {
    times.push_back(phase.start_s);
    times.push_back(phase.start_s + ramp_s_);
  }
  std::sort(times.begin(), times.end());
  return times;
}

// With r_full (1 - exp(-t / lag)) on the way up, the integral of the equation of motion gives the
// turn of both moment phases together as r_full (t_up - t_down).
TurnProfile turnToRest(double turn_rad, double r_full, double r_max, double lag_s, double ramp_s) {
  const double cap = std::min(r_max, 0.999 * r_full);
  const double up_to_cap = -lag_s * std::log1p(-cap / r_full);
  const auto turned = [&](double up_s) { return r_full * (up_s - slowDown(up_s, lag_s)); };
  double up_s = up_to_cap;
  double steady_s = 0.0;
  if (turn_rad >= turned(up_to_cap)) {
    steady_s = (turn_rad - turned(up_to_cap)) / cap;
  } else {
    up_s = solveRising(up_to_cap, turn_rad, turned);
  }
  const double top = r_full * (1.0 - std::exp(-up_s / lag_s));
  TurnProfile profile(lag_s, ramp_s);
  profile.append(0.0, r_full, up_s);
  profile.append(top, top, steady_s);
  profile.append(top, -r_full, slowDown(up_s, lag_s));
  profile.finish(0.0);
  return profile;
}

LooseTurn turnLoose(double turn_rad, double r_full, double r_max, double lag_s, double ramp_s,
                    double brake_radps2) {
  const double cap = std::min(r_max, 0.999 * r_full);
  const double up_to_cap = -lag_s * std::log1p(-cap / r_full);
  const auto rate = [&](double up_s) { return r_full * (1.0 - std::exp(-up_s / lag_s)); };
  const auto turned = [&](double up_s) {
    const double r = rate(up_s);
    const double left = std::max(r * std::min(lag_s, kLooseLagS), r * r / (2.0 * brake_radps2));
    return r_full * up_s - lag_s * r + left;
  };
  double up_s = up_to_cap;
  double steady_s = 0.0;
  if (turn_rad >= turned(up_to_cap)) {
    steady_s = (turn_rad - turned(up_to_cap)) / cap;
  } else {
    up_s = solveRising(up_to_cap, turn_rad, turned);
  }
  LooseTurn loose{TurnProfile(lag_s, ramp_s), up_s + steady_s};
  loose.profile.append(0.0, r_full, up_s);
  loose.profile.append(rate(up_s), rate(up_s), steady_s);
  loose.profile.finish(rate(up_s));
  return loose;
}

}  // namespace otter_nav::optimizer
