#include "safety.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::mission {
namespace {

constexpr double kLeastThrustShare = 0.4;
constexpr double kReserveInWind = 2.0;  // thrust kept per share that the disturbance takes
constexpr double kLessThrust = 0.1;     // each time the vessel couldn't follow

}  // namespace

double disturbanceShare(double disturbance_n, const vessel::Thrusters& thrusters) {
  return disturbance_n / (2.0 * thrusters.ahead_max_n);
}

double planThrustShare(double share_in_calm, double disturbance_share, int times_left_behind) {
  constexpr double kStep = 0.05;
  const double share =
      share_in_calm - kReserveInWind * disturbance_share - times_left_behind * kLessThrust;
  return std::max(kLeastThrustShare, kStep * std::floor(share / kStep + 1e-9));
}

double planClearance(const SupervisorOptions& options, std::size_t level, double disturbance_share,
                     double thrust_share, const vessel::Hull& hull, double room_m) {
  const double listed = centreClearance(hull, options.side_clearances_m[level]);
  const double narrowest = centreClearance(hull, options.side_clearances_m.back());
  constexpr double kSlowShare = 0.5;  // of the plan's thrust, that moves the vessel in its turns
  const double crab_rad =
      std::min(std::asin(std::min(1.0, disturbance_share / (kSlowShare * thrust_share))),
               std::atan2(hull.length_m, hull.beam_m));  // the corner abeam
  const double crabwise =
      0.5 * (hull.length_m * std::sin(crab_rad) + hull.beam_m * (std::cos(crab_rad) - 1.0));
  const double widened =
      narrowest + crabwise +
      (listed - narrowest) * (1.0 + options.widening_in_wind * disturbance_share);
  return std::min(widened, std::max(listed, room_m));
}

Safety::Safety(const SupervisorOptions& options, const vessel::Parameters& vessel)
    : options_(options), vessel_(vessel), levels_(options.side_clearances_m.size()) {}

double Safety::narrowest() const {
  return centreClearance(vessel_.hull, options_.side_clearances_m.back());
}

double Safety::critical() const {
  return centreClearance(vessel_.hull, options_.critical_side_clearance_m);
}

feasibility::SafetyLimits Safety::limits(double thrust_share, double room_m) {
  while (!levels_.atNarrowest() &&
         centreClearance(vessel_.hull, options_.side_clearances_m[levels_.level()]) > room_m) {
    levels_.narrower();
  }
  const double clearance = planClearance(options_, levels_.level(), disturbance_share_,
                                         thrust_share, vessel_.hull, room_m);
  return feasibility::SafetyLimits::of(vessel_, clearance, thrust_share);
}

double Safety::freeThrustShare() const {
  return planThrustShare(options_.thrust_share, disturbance_share_, times_left_behind_);
}

double Safety::movingThrustShare() const {
  return std::min(options_.thrust_share, freeThrustShare() + times_refused_ * kLessThrust);
}

bool Safety::countsOnTooMuch(double planned_share) const {
  constexpr double kTooMuch = 0.1;  // of the limits
  return planned_share > freeThrustShare() + kTooMuch + 1e-9;
}

void Safety::newGoal() {
  times_left_behind_ = 0;
  times_refused_ = 0;
}

void Safety::feel(double disturbance_n) {
  disturbance_share_ = disturbanceShare(disturbance_n, vessel_.thrusters);
}

bool Safety::refused(bool from_vessel) {
  const bool more = levels_.narrower();
  if (from_vessel && !more) {
    ++times_refused_;
  }
  return more;
}

void Safety::planTaken() {
  times_refused_ = 0;
  levels_.widest();
}

}  // namespace otter_nav::mission
