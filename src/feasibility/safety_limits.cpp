#include "otter_nav/feasibility/safety_limits.hpp"

namespace otter_nav::feasibility {
namespace {

// Of its own, that plans use: the rest is for control.
constexpr double kThrustShare = 0.97;
constexpr double kSpeedShare = 0.98;
// Over the rate at which the thrusters against each other hold a turn.
constexpr double kYawRateShare = 1.02;

constexpr double kBesideM = 0.26;  // between the hull's side and what lies beside it

}  // namespace

SafetyLimits SafetyLimits::of(const vessel::Parameters& vessel) {
  return of(vessel, 0.5 * vessel.hull.beam_m + kBesideM);
}

SafetyLimits SafetyLimits::of(const vessel::Parameters& vessel, double clearance_m,
                              double thrust_share) {
  const vessel::Thrusters& thrusters = vessel.thrusters;
  const double moment = thrusters.lever_arm_m * (thrusters.ahead_max_n + thrusters.astern_max_n);
  SafetyLimits limits;
  limits.clearance_m = clearance_m;
  limits.hull = vessel.hull;
  limits.thrust_share = kThrustShare * thrust_share;
  limits.speed_max_mps = kSpeedShare * thrust_share * vessel.top_speed_mps;
  limits.yaw_rate_max_radps = kYawRateShare * moment / vessel.paper.d3_kgm2ps;
  return limits;
}

}  // namespace otter_nav::feasibility
