#include "otter_nav/mission/margins.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::mission {

double disturbanceShare(double disturbance_n, const vessel::Thrusters& thrusters) {
  return disturbance_n / (2.0 * thrusters.ahead_max_n);
}

double planThrustShare(const MarginOptions& options, double disturbance_share,
                       int times_left_behind) {
  constexpr double kStep = 0.05;
  const double share = options.thrust_share - options.reserve_in_wind * disturbance_share -
                       times_left_behind * options.thrust_share_step;
  return std::max(options.thrust_share_min, kStep * std::floor(share / kStep + 1e-9));
}

double planClearance(const MarginOptions& options, std::size_t rung, double disturbance_share,
                     double thrust_share, const vessel::Hull& hull, double room_m) {
  const double listed = options.plan_clearances_m[rung];
  const double narrowest = options.plan_clearances_m.back();
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

}  // namespace otter_nav::mission
