#include "optimizer/solve/targets.hpp"

#include <algorithm>
#include <array>

#include "otter_nav/feasibility/hull_cover.hpp"

namespace otter_nav::optimizer {
namespace {

// A cell's square reaches this far beyond its centre, in cells (DistanceField::smooth measures to
// centres), as seen from most directions.
constexpr double kSquareCells = 0.7;
constexpr double kHullMarginM = 0.03;
constexpr double kArrivalSpeedMaxShare = 0.9;  // of the speed aimed at

// Aimed at, of the limits that are verified.
constexpr double kThrustShare = 0.979;
constexpr double kSpeedShare = 0.99;
constexpr double kYawRateShare = 0.905;
constexpr double kHeadingForceShare = 0.08;  // least |w| while turning, of both thrusters ahead

struct Manner {
  bool careful;
  double thrust_factor;
  double weight_factor;
  double length_factor;   // of the pieces
  double arrival_factor;  // of the speed at which the arrival begins
};

constexpr std::array<Manner, kAttempts> kManners = {{{false, 1.0, 1.0, 1.0, 1.0},
                                                     {false, 1.0, 1.0, 0.7, 0.7},
                                                     {true, 1.0, 3.0, 0.9, 0.5},
                                                     {true, 0.8, 10.0, 0.7, 0.3}}};

SplineLimits limitsOf(const Manner& manner, const GlobalOptions& options,
                      const vessel::Parameters& vessel, const feasibility::SafetyLimits& safety,
                      double cell_m) {
  SplineLimits limits;
  limits.clearance_m = safety.clearance_m + options.clearance_margin_m + kSquareCells * cell_m;
  const feasibility::HullCover hull(safety.hull);
  limits.hull_offset_m = hull.offset_m;
  limits.hull_clearance_m = hull.radius_m + kHullMarginM + kSquareCells * cell_m;
  const double share = kThrustShare * safety.thrust_share * manner.thrust_factor;
  limits.thrust_ahead_n = share * vessel.thrusters.ahead_max_n;
  limits.thrust_astern_n = share * vessel.thrusters.astern_max_n;
  limits.speed_mps = kSpeedShare * safety.speed_max_mps * manner.thrust_factor;
  limits.yaw_rate_radps = kYawRateShare * safety.yaw_rate_max_radps;
  limits.heading_force_n = kHeadingForceShare * 2.0 * vessel.thrusters.ahead_max_n;
  return limits;
}

EndOptions endsOf(const Manner& manner, const GlobalOptions& options,
                  const vessel::Parameters& vessel, const feasibility::SafetyLimits& safety,
                  double thrust_share) {
  EndOptions ends;
  ends.limits.thrust_share = thrust_share;
  ends.limits.yaw_rate_max_radps = kYawRateShare * safety.yaw_rate_max_radps;
  ends.limits.drift_mps = options.drift_mps;
  ends.limits.surge_ramp_s = options.surge_ramp_s;
  ends.limits.brake_ramp_s = options.brake_ramp_s;
  ends.limits.astern_share = options.astern_share;
  ends.turn_least_rad = options.spin_angle_rad;
  ends.careful = manner.careful;
  const double top =
      std::min(2.0 * thrust_share * vessel.thrusters.ahead_max_n / vessel.paper.d1_kgps,
               kSpeedShare * safety.speed_max_mps);
  ends.arrival_speed_mps = options.arrival_speed_share * manner.arrival_factor * top;
  ends.arrival_speed_max_mps = kArrivalSpeedMaxShare * top;
  return ends;
}

}  // namespace

Aims aimsOf(int attempt, const GlobalOptions& options, const vessel::Parameters& vessel,
            const feasibility::SafetyLimits& safety, double cell_m) {
  const Manner& manner = kManners[static_cast<std::size_t>(attempt)];
  const double share = kThrustShare * safety.thrust_share * manner.thrust_factor;
  Aims aims;
  aims.limits = limitsOf(manner, options, vessel, safety, cell_m);
  aims.weights.time = options.weight_time;
  aims.weights.length = options.weight_length;
  aims.weights.smooth = options.weight_smooth;
  aims.weights.clearance = options.weight_clearance * manner.weight_factor;
  aims.weights.dynamics = options.weight_dynamics * manner.weight_factor;
  aims.weights.original = 0.0;
  aims.initial.piece_length_m = options.piece_length_m * manner.length_factor;
  aims.initial.force_share = 0.9 * share;
  aims.initial.speed_max_mps = 0.97 * aims.limits.speed_mps;
  aims.initial.clearance_m = aims.limits.clearance_m;
  aims.ends = endsOf(manner, options, vessel, safety, share);
  return aims;
}

}  // namespace otter_nav::optimizer
