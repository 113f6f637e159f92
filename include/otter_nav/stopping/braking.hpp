// From a sailed trajectory to rest, and how far it stays clear. Obstacles start where the sailed
// trajectory does.
#pragma once

#include <Eigen/Core>

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::stopping {

struct Braking {
  trajectory::Trajectory trajectory;  // starts at the sailed trajectory's `at_s`, ends at rest
  bool clear = false;                 // keeps the clearance, within the thrusters' limits
  double clearance_m = 0.0;           // the least along it, sampled; only if not clear
};

// The gentlest stop from `at_s` (s from the trajectory's start) that keeps the clearance: along
// the sailed way, slowed down in time, or straightened out and then ahead in a line. A hull without
// a side thruster can't brake harder than its drag in a curve (its heading would have to swing
// across, docs/model.md), so a hard stop straightens first. If nothing keeps `clearance_m` of the
// hull's centre, the stop that comes nearest to it, with `clear` false.
[[nodiscard]] Braking brakingTrajectory(const trajectory::Trajectory& sailed, double at_s,
                                        const feasibility::Obstacles& obstacles,
                                        const vessel::Parameters& vessel, double clearance_m);

// The first time from `from_s` on at which the trajectory's clearance is below `clearance_m`.
// Continuous: it moves on by what the clearance allows at the piece's speed (the control polygon
// of its velocity bounds it).
struct Conflict {
  bool found = false;
  double time_s = 0.0;  // from the trajectory's start
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double clearance_m = 0.0;  // there
};
[[nodiscard]] Conflict firstConflict(const trajectory::Trajectory& trajectory, double from_s,
                                     const feasibility::Obstacles& obstacles, double clearance_m);

}  // namespace otter_nav::stopping
