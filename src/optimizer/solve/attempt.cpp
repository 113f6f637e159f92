#include "optimizer/solve/attempt.hpp"

#include <algorithm>
#include <array>

#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/feasibility/lean.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/rest.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kHullMarginM = 0.03;
constexpr double kClearanceMarginM = 0.05;
constexpr double kPieceLengthM = 17.0;
// Bow to a firm load the vessel gets under way slowly, turning with the path; fewer pieces follow.
constexpr double kPieceLengthInLoadM = 24.0;
constexpr double kSlowestInLoadMps = 0.3;
constexpr double kWeightClearance = 20.0;   // of squared metres too near
constexpr double kWeightRoom = 0.1;         // the same, nearer than is preferred
constexpr double kWeightHullRoom = 10.0;    // the same, of the hull's ends
constexpr double kWeightDynamics = 5.0;     // of squared shares of a thruster too much
constexpr double kArrivalSpeedShare = 0.6;  // of the speed wanted, when the brake begins
constexpr double kGentleBrakeS = 2.0;
constexpr double kBeforeBraking = 0.95;
constexpr double kDriftShare = 0.4;  // of the speed limit
constexpr double kArrivalSpeedMaxShare = 0.9;

// Wanted, of the limits that are verified.
constexpr double kThrustShare = 0.95 / 0.97;
constexpr double kSpeedShare = 4.85 / 4.9;
constexpr double kYawRateShare = 1.8 / 1.989;
constexpr double kHeadingForceShare = 0.08;  // least |w| while turning, of both thrusters ahead
constexpr double kSwayDragShare = 0.5;       // of what holds |w| at the speed limit

struct Care {
  bool careful;
  double thrust_factor;
  double weight_factor;
  double length_factor;   // of the pieces
  double arrival_factor;  // of the speed at which the arrival begins
};

constexpr std::array<Care, kAttempts> kCares = {{{false, 1.0, 1.0, 1.0, 1.0},
                                                 {false, 1.0, 1.0, 0.7, 0.7},
                                                 {true, 1.0, 3.0, 0.9, 0.5},
                                                 {true, 0.8, 10.0, 0.7, 0.3}}};

SplineLimits limitsOf(const Care& care, const vessel::Parameters& vessel,
                      const feasibility::SafetyLimits& safety, double cell_m) {
  SplineLimits limits;
  limits.clearance_m = safety.clearance_m + kClearanceMarginM + kSquareCells * cell_m;
  if (safety.preferred_clearance_m > safety.clearance_m && !care.careful) {
    limits.room_m = safety.preferred_clearance_m + kClearanceMarginM + kSquareCells * cell_m;
  }
  const feasibility::HullCover hull(safety.hull, safety.hull_margin_m);
  limits.hull_offset_m = hull.offset_m;
  limits.hull_clearance_m = hull.radius_m + kHullMarginM + kSquareCells * cell_m;
  // Where some is asked for, on the narrow levels.
  const bool narrow =
      safety.hull_margin_m > 0.0 &&
      safety.clearance_m < 0.5 * safety.hull.beam_m + feasibility::kPreferredBesideM;
  if (narrow && safety.hull_margin_m < feasibility::kPreferredBesideM && !care.careful) {
    limits.hull_room_m =
        limits.hull_clearance_m + feasibility::kPreferredBesideM - safety.hull_margin_m;
  }
  const feasibility::HullCover leaning(
      safety.hull, std::min(feasibility::kLeaningMarginM, safety.hull_margin_m));
  limits.leaning_clearance_m = leaning.radius_m + kHullMarginM + kSquareCells * cell_m;
  const double share = kThrustShare * safety.thrust_share * care.thrust_factor;
  limits.thrust_ahead_n = share * vessel.thrusters.ahead_max_n;
  limits.thrust_astern_n = share * vessel.thrusters.astern_max_n;
  // In slow motion. A low speed limit leaves thrust to spare: it needs no more care.
  const double slow = feasibility::speedShare(vessel, safety);
  limits.speed_mps =
      kSpeedShare * safety.speed_max_mps / slow * std::min(1.0, care.thrust_factor / slow);
  limits.slowing = safety.slowing;
  limits.slowing.start_mps = kSpeedShare * safety.slowing.start_mps / slow;
  limits.yaw_rate_radps = kYawRateShare * safety.yaw_rate_max_radps / slow;
  limits.heading_force_n = std::min(kHeadingForceShare * 2.0 * vessel.thrusters.ahead_max_n,
                                    mostHeadingForce(vessel, safety));
  return limits;
}

EndOptions endsOf(const Care& care, const vessel::Parameters& vessel,
                  const feasibility::SafetyLimits& safety, double thrust_share) {
  EndOptions ends;
  ends.limits.thrust_share = thrust_share;
  ends.limits.yaw_rate_max_radps = kYawRateShare * safety.yaw_rate_max_radps;
  ends.careful = care.careful;
  ends.limits.disturbance = safety.disturbance;
  if (!vessel::paperHolds(vessel)) {
    ends.limits.drift_mps = 0.0;
  }
  const double top =
      std::min(2.0 * thrust_share * vessel.thrusters.ahead_max_n / vessel.paper.d1_kgps,
               kSpeedShare * safety.speed_max_mps);
  // Under a low speed limit there is little force to steer by at less: it is left late, and so
  // gently that it isn't exceeded before.
  const double slow = feasibility::speedShare(vessel, safety);
  ends.arrival_speed_mps = kArrivalSpeedShare * (1.0 - (1.0 - care.arrival_factor) * slow) * top;
  ends.arrival_speed_max_mps = kArrivalSpeedMaxShare * top;
  if (slow < 1.0) {
    ends.limits.speed_max_mps = kSpeedShare * safety.speed_max_mps;
    // What the vessel loses while the thrust turns round comes on top.
    const double lost = 0.5 * ends.limits.brake_ramp_s *
                        (1.0 / kGentleBrakeS + vessel.paper.d1_kgps / vessel.paper.m1_kg);
    ends.arrival_speed_max_mps = kBeforeBraking * top / (1.0 + lost);
    ends.arrival_speed_mps =
        std::min(ends.arrival_speed_mps, kArrivalSpeedMaxShare * ends.arrival_speed_max_mps);
    const double astern_n = 2.0 * thrust_share * vessel.thrusters.astern_max_n;
    ends.limits.astern_share =
        std::min(ends.limits.astern_share,
                 vessel.paper.m1_kg * safety.speed_max_mps / (kGentleBrakeS * astern_n));
    ends.limits.drift_mps = std::min(ends.limits.drift_mps, kDriftShare * safety.speed_max_mps);
  }
  return ends;
}

}  // namespace

double mostHeadingForce(const vessel::Parameters& vessel, const feasibility::SafetyLimits& safety) {
  return feasibility::headingForceAtSpeed(vessel, safety, kSwayDragShare);
}

Attempt attemptOf(int number, const GlobalOptions& options, const vessel::Parameters& vessel,
                  const feasibility::SafetyLimits& safety, double cell_m) {
  const Care& care = kCares[static_cast<std::size_t>(number)];
  const double share = kThrustShare * safety.thrust_share * care.thrust_factor;
  Attempt attempt;
  attempt.limits = limitsOf(care, vessel, safety, cell_m);
  attempt.weights.time = 1.0;
  attempt.weights.length = options.weight_length;
  attempt.weights.smooth = options.weight_smooth;
  attempt.weights.clearance = kWeightClearance * care.weight_factor;
  attempt.weights.room = kWeightRoom;
  attempt.weights.hull_room = kWeightHullRoom;
  attempt.weights.dynamics = kWeightDynamics * care.weight_factor;
  const bool firm = vessel::isFirmLoad(vessel, safety.disturbance);
  attempt.initial.piece_length_m =
      (firm ? kPieceLengthInLoadM * feasibility::speedShare(vessel, safety) : kPieceLengthM) *
      care.length_factor;
  if (firm) {
    attempt.initial.slowest_mps = kSlowestInLoadMps;
  }
  attempt.initial.force_share = 0.9 * share;
  attempt.initial.speed_max_mps = 0.97 * attempt.limits.speed_mps;
  attempt.initial.clearance_m = attempt.limits.clearance_m;
  attempt.initial.load_n = vessel::InverseDynamics(vessel, safety.disturbance).greatestLoad();
  attempt.ends = endsOf(care, vessel, safety, share);
  // Turning under a load takes thrust and room: every other attempt does without.
  attempt.ends.straight_arrival = attempt.initial.load_n > 0.0 && number % 2 == 1;
  attempt.ends.in_load = firm;
  return attempt;
}

}  // namespace otter_nav::optimizer
