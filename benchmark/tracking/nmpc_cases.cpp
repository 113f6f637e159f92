#include "nmpc_cases.hpp"

#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/rk4.hpp"

namespace otter_nav::benchmark {
namespace {

constexpr double kRadius = 20.0;
constexpr double kSpeed = 3.0;
constexpr double kStepM = 3.0;
constexpr double kStepPeriodS = 4.0;

}  // namespace

NmpcCycles::NmpcCycles(NmpcCase which, int stages, double horizon_s,
                       const vessel::Parameters& vessel)
    : which_(which), vessel_(vessel) {
  ocp_.stages = stages;
  ocp_.step_s = horizon_s / stages;
  vessel::State q;
  q << 100.0, 100.0, 1.0, 1.0, 1.0, 1.0;
  ocp_.weights.state = q * ocp_.step_s;
  ocp_.weights.terminal = q;
  ocp_.weights.thrusts.setConstant(1e-4 * ocp_.step_s);
  ocp_.lower_n.setConstant(-vessel.thrusters.astern_max_n);
  ocp_.upper_n.setConstant(vessel.thrusters.ahead_max_n);
  disturbance_.force_n = {0.0, 10.0};
  state_ << kRadius, 0.0, 0.5 * kPi, kSpeed, 0.0, kSpeed / kRadius;
}

void NmpcCycles::fill(tracker::OcpReference& reference) const {
  const bool aside =
      which_ == NmpcCase::kSaturated && std::fmod(time_s_, kStepPeriodS) >= 0.5 * kStepPeriodS;
  const double radius = kRadius + (aside ? kStepM : 0.0);
  const double rate = kSpeed / kRadius;
  for (int k = 0; k <= ocp_.stages; ++k) {
    const double angle = rate * (time_s_ + k * ocp_.step_s);
    reference.states[k] << radius * std::cos(angle), radius * std::sin(angle), 0.5 * kPi + angle,
        kSpeed, 0.0, rate;
    if (k < ocp_.stages) {
      reference.thrusts[k].setConstant(0.5 * vessel_.manoeuvring.surge_drag_kgps * kSpeed);
    }
  }
}

void NmpcCycles::advance(const vessel::Thrusts& thrusts) {
  state_ = rk4Step(
      [&](double, const vessel::State& x) {
        return vessel::stateDerivative(x, thrusts, vessel_.manoeuvring, vessel_.thrusters,
                                       disturbance_);
      },
      time_s_, state_, period());
  time_s_ += period();
}

}  // namespace otter_nav::benchmark
