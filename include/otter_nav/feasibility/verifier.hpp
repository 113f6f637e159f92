// Whole-trajectory verification: what leaves the planner as solved has passed this, and what the
// vessel brakes or backs off along. Continuity, clearance and limits are checked along the whole
// time, not at samples alone, but for the hull turned into the wind (checkLeaning), which is looked
// at each 0.05 s:
//   clearance  by the one walk (clearance_walk.hpp), with a bound of the speed on the piece (the
//              control polygon of its velocity) for the hull's centre and the discs that cover it
//   thrusts    through the flatness map in steps of `step_s`, each step widened by the parabola
//              through its neighbours; on straight pieces, where |w| may vanish, exactly
#pragma once

#include <string>

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/trajectory/boundary.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::trajectory {
class MotionAlong;
}  // namespace otter_nav::trajectory

namespace otter_nav::feasibility {

// How closely limits and ends are looked at.
struct Tolerances {
  bool keep_hull_clear = true;  // the discs that cover the hull touch nothing
  // Least |w| where the path is not straight, of both thrusters' force ahead: less and the heading
  // would be undefined there.
  double heading_force_share = 0.032;
  double heading_rad = 0.08;  // of an end at rest
  double position_m = 0.01;   // of both ends
  double step_s = 0.01;       // of the thrusts
};

// What a piece does wrong.
enum class Fault {
  kNone,
  kThrust,
  kSpeed,
  kYawRate,
  kHeadingUndefined,
  kHeadingJump,
  kAstern,
  kSway,
  kClearance,
  kHull
};

struct Verification {
  bool ok = false;
  std::string reason;          // the first fault, a sentence with its time; empty when ok
  double fault_s = 0.0;        // its time
  Fault fault = Fault::kNone;  // where it is a piece's, not one of an end or a joint
  // Worst figures of what was looked at (up to the first fault).
  double clearance_m = 0.0;
  double thrust_share = 0.0;  // 1: a thruster is at its limit
  double speed_mps = 0.0;
  double yaw_rate_radps = 0.0;
  double heading_force_n = 0.0;  // least |w| where the path is not straight
};

// `obstacles` start where the trajectory does. Faults: empty or not finite, start or goal not met,
// a jump at a joint, too near an obstacle or out of the map, thrust, speed or yaw rate out of
// range, heading undefined or jumping. Allocates for the reason only. `motion`: along the
// trajectory from the start's heading, under the limits' disturbance, where the caller has it by
// the manoeuvring model; without, it is made here.
[[nodiscard]] Verification verify(const trajectory::Trajectory& trajectory,
                                  const Obstacles& obstacles, const vessel::Parameters& vessel,
                                  const trajectory::Boundary& start,
                                  const trajectory::Boundary& goal, const SafetyLimits& limits,
                                  const Tolerances& tolerances = {},
                                  const trajectory::MotionAlong* motion = nullptr);
// Without ends to meet: a part of a trajectory, or one sailed already. By the paper's model for all
// vessels, as the heading at its start is not known.
[[nodiscard]] Verification verify(const trajectory::Trajectory& trajectory,
                                  const Obstacles& obstacles, const vessel::Parameters& vessel,
                                  const SafetyLimits& limits, const Tolerances& tolerances = {});

}  // namespace otter_nav::feasibility
