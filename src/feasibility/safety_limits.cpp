#include "otter_nav/feasibility/safety_limits.hpp"

#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::feasibility {
namespace {

// Of its own, that plans use: the rest is for control.
constexpr double kThrustShare = 0.97;
constexpr double kSpeedShare = 0.98;
// Over the rate at which the thrusters against each other hold a turn.
constexpr double kYawRateShare = 1.02;

constexpr double kSlowingShare = 0.3;  // of what the lesser drag does

constexpr double kBesideM = 0.26;  // between the hull's side and what lies beside it

}  // namespace

SafetyLimits SafetyLimits::of(const vessel::Parameters& vessel) {
  return of(vessel, 0.5 * vessel.hull.beam_m + kBesideM);
}

SafetyLimits SafetyLimits::of(const vessel::Parameters& vessel, double clearance_m,
                              double thrust_share) {
  const vessel::Thrusters& thrusters = vessel.thrusters;
  const double moment = vessel::greatestMoment(thrusters);
  SafetyLimits limits;
  limits.clearance_m = clearance_m;
  limits.hull = vessel.hull;
  limits.thrust_share = kThrustShare * thrust_share;
  limits.speed_max_mps = kSpeedShare * thrust_share * vessel.top_speed_mps;
  limits.limitSpeed(vessel.speed_max_mps);
  limits.yaw_rate_max_radps = kYawRateShare * moment / vessel.paper.d3_kgm2ps;
  return limits;
}

void SafetyLimits::limitSpeed(double speed_mps) {
  if (speed_mps > 0.0) {
    speed_max_mps = std::min(speed_max_mps, kSpeedShare * speed_mps);
  }
}

SafetyLimits SafetyLimits::startingAt(double speed_mps, const vessel::Parameters& vessel) const {
  constexpr double kStillFaster = 1.05;  // what accelerates goes on to for a moment
  constexpr double kNoticeS = 3.0;
  SafetyLimits limits = *this;
  if (speed_mps > speed_max_mps) {
    const vessel::PaperModel& m = vessel.paper;
    limits.slowing = {kStillFaster * speed_mps,
                      kSlowingShare * std::min(m.d1_kgps, m.d2_kgps) / m.m1_kg, kNoticeS};
  }
  return limits;
}

double headingForceAtSpeed(const vessel::Parameters& vessel, const SafetyLimits& limits,
                           double share) {
  return share * vessel.paper.d2_kgps * limits.speed_max_mps;
}

double leastHeadingForce(const vessel::Parameters& vessel, const SafetyLimits& limits,
                         double share) {
  constexpr double kOfSteady = 0.3;
  return std::min(share * 2.0 * vessel.thrusters.ahead_max_n,
                  headingForceAtSpeed(vessel, limits, kOfSteady));
}

double usualSpeed(const vessel::Parameters& vessel, const SafetyLimits& limits) {
  return kSpeedShare * limits.thrust_share / kThrustShare * vessel.top_speed_mps;
}

double speedShare(const vessel::Parameters& vessel, const SafetyLimits& limits) {
  return std::min(1.0, limits.speed_max_mps / usualSpeed(vessel, limits));
}

}  // namespace otter_nav::feasibility
