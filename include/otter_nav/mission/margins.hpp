// What a plan leaves for wind and current, of which it knows the force alone.
#pragma once

#include <cstddef>
#include <vector>

#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::mission {

struct MarginOptions {
  // Clearances of the hull's centre to anything occupied, m, tried from the widest to the
  // narrowest when a plan fails; none is made with less than the last.
  std::vector<double> plan_clearances_m = {1.6, 1.2, 0.9, 0.8};
  // How much further apart they lie, from the narrowest on, per share of the thrust ahead that the
  // disturbance takes: gusts carry the vessel off its way by as much.
  double widening_in_wind = 9.0;
  // Share of the thrust that plans may use; the rest is for what the plan doesn't know. Less by
  // the disturbance's share times `reserve_in_wind` (its moment and its gusts ask for some as
  // well) and by `thrust_share_step` each time the vessel couldn't follow, but never less than
  // `thrust_share_min`.
  double thrust_share = 0.95;
  double thrust_share_min = 0.4;
  double thrust_share_step = 0.1;
  double reserve_in_wind = 2.0;
};

// `disturbance_n` over the thrust of both propellers full ahead.
[[nodiscard]] double disturbanceShare(double disturbance_n, const vessel::Thrusters& thrusters);

// Of the limits, for a plan; in steps of 0.05, so that one planner serves many requests.
[[nodiscard]] double planThrustShare(const MarginOptions& options, double disturbance_share,
                                     int times_left_behind);

// The clearance `rung` of the list asks for, m. Against a force from the side the hull goes
// crabwise and reaches further to both sides: the narrowest grows by that. Not more than the start
// and the goal have (`room_m`), unless the list itself asks for it.
[[nodiscard]] double planClearance(const MarginOptions& options, std::size_t rung,
                                   double disturbance_share, double thrust_share,
                                   const vessel::Hull& hull, double room_m);

}  // namespace otter_nav::mission
