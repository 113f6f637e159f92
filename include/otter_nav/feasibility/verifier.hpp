// Whole-trajectory verification: what leaves the planner as solved has passed this. Continuity,
// clearance and limits are checked along the whole time, not at samples alone:
//   clearance  jumps along time by what the distance field leaves over, divided by a bound of the
//              speed on the piece (the control polygon of its velocity), so no corner is stepped
//              over; bow and stern are watched in the same way by circles that cover the hull
//   thrusts    through the flatness map in steps of `step_s`, each step widened by the parabola
//              through its neighbours; on straight pieces, where |w| may vanish, exactly
#pragma once

#include <Eigen/Core>
#include <string>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/trajectory/boundary.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::feasibility {

struct CheckOptions {
  double clearance_m = 0.8;  // of the hull's centre from every occupied cell's square
  bool check_hull = true;    // circles that cover the hull's outline touch nothing
  double speed_max_mps = 5.0;
  double yaw_rate_max_radps = 2.0;
  double thrust_share = 1.0;         // of each thruster's limits
  double heading_force_min_n = 1.0;  // least |w| where the way is not straight
  double heading_tolerance_rad = 0.08;
  double position_tolerance_m = 0.01;
  double step_s = 0.01;
};

struct Verification {
  bool ok = false;
  std::string reason;    // the first fault, a sentence with its time; empty when ok
  double fault_s = 0.0;  // its time
  // Worst figures of what was looked at (up to the first fault).
  double clearance_m = 0.0;
  double thrust_share = 0.0;  // 1: a thruster is at its limit
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
  double heading_force_n = 0.0;  // least |w| where the way is not straight
};

// Faults: empty or not finite, start or goal not met, a jump at a joint, too near an obstacle or
// out of the map, thrust, speed or yaw rate out of range, heading undefined or jumping. Allocates
// for the reason only.
[[nodiscard]] Verification verify(const trajectory::Trajectory& trajectory,
                                  const map::DistanceField& field, const vessel::Parameters& vessel,
                                  const trajectory::Boundary& start,
                                  const trajectory::Boundary& goal, const CheckOptions& options);
// Without ends to meet: a part of a trajectory, or one sailed already.
[[nodiscard]] Verification verify(const trajectory::Trajectory& trajectory,
                                  const map::DistanceField& field, const vessel::Parameters& vessel,
                                  const CheckOptions& options);

}  // namespace otter_nav::feasibility
