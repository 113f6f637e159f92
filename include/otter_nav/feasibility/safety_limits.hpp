// What a plan must keep to: made once a request from the vessel, the mission and the weather, and
// passed down to guide path, trees, optimizer and verifier. Nobody below has limits of his own.
#pragma once

#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::feasibility {

struct SafetyLimits {
  // Of the hull's centre from everything occupied, m. The hull's outline touches nothing besides.
  double clearance_m = 0.8;
  vessel::Hull hull;
  // Of each thruster's limits, verified; the rest is for control, wind and current.
  double thrust_share = 0.97;
  double speed_max_mps = 5.0;  // over ground
  // Under way; a turn on the spot is limited by its thrust alone.
  double yaw_rate_max_radps = 1.8;

  // Of a vessel in calm water: its hull, and its own top speed.
  [[nodiscard]] static SafetyLimits of(const vessel::Parameters& vessel);
};

}  // namespace otter_nav::feasibility
