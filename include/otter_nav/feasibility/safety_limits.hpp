// What a plan must keep to: made once a request from the vessel, the mission and the weather, and
// passed down to guide path, trees, optimizer and verifier. Nobody below has limits of his own:
// what aims at less than a limit takes a share of it.
#pragma once

#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::feasibility {

struct SafetyLimits {
  // Of the hull's centre from everything occupied, m. The hull's outline touches nothing besides.
  double clearance_m = 0.8;
  vessel::Hull hull;
  // Of each thruster's limits; the rest is for control, wind and current.
  double thrust_share = 0.97;
  double speed_max_mps = 4.9;  // over ground
  double yaw_rate_max_radps = 2.0;
  // What the thrusters work against besides, all along: every demand of a plan is made and verified
  // with it (docs/planner.md).
  vessel::Disturbance disturbance;

  // Of a vessel that may use `thrust_share` of what plans usually take, for instance less in wind:
  // its speed falls with it, as under linear drag.
  [[nodiscard]] static SafetyLimits of(const vessel::Parameters& vessel, double clearance_m,
                                       double thrust_share = 1.0);
  // With room beside the hull: half its beam and what otters take beside theirs.
  [[nodiscard]] static SafetyLimits of(const vessel::Parameters& vessel);
};

}  // namespace otter_nav::feasibility
