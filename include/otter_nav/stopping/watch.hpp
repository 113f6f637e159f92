// What comes into the way of a trajectory that is being sailed. Obstacles start where it does.
#pragma once

#include <Eigen/Core>
#include <limits>

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::stopping {

struct Conflict {
  bool found = false;
  double time_s = 0.0;                                 // from the trajectory's start
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // of the hull's centre
  double clearance_m = 0.0;                            // there, of what is watched
};

// The first time from `from_s` on at which the hull's centre is nearer to anything than
// `clearance_m`, by the one walk (feasibility/clearance_walk.hpp).
[[nodiscard]] Conflict firstConflict(const trajectory::Trajectory& trajectory, double from_s,
                                     const feasibility::Obstacles& obstacles, double clearance_m);

// The least, m, that the hull's centre has from `from_s` on, in steps of 0.05 s.
[[nodiscard]] double leastClearance(const trajectory::Trajectory& trajectory, double from_s,
                                    const feasibility::Obstacles& obstacles);

// How the hull truly lies beside where a trajectory has it: the tracker makes that good within a
// few seconds.
struct Off {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
};
[[nodiscard]] Off offTrajectory(const trajectory::Trajectory& trajectory, double at_s,
                                const vessel::State& state, const vessel::Parameters& vessel,
                                const vessel::Disturbance& disturbance = {});

// The same for the hull's exact outline in the attitude planned with `disturbance`, up to `to_s`,
// and `off` that at first. Where `edge` is false the map's edge is no obstacle.
[[nodiscard]] Conflict outlineConflict(const trajectory::Trajectory& trajectory, double from_s,
                                       double to_s, const feasibility::Obstacles& obstacles,
                                       const vessel::Parameters& vessel, double clearance_m,
                                       bool edge = true,
                                       const vessel::Disturbance& disturbance = {},
                                       const Off& off = {});

// Whether the hull in its true attitude, which may be far from the planned one where wind and waves
// turn it, is about to touch: within the next moment along the trajectory, off it as it is now.
[[nodiscard]] bool isAboutToTouch(const trajectory::Trajectory& trajectory, double at_s,
                                  const vessel::State& state,
                                  const feasibility::Obstacles& obstacles,
                                  const vessel::Parameters& vessel,
                                  const vessel::Disturbance& disturbance = {});

// The same where the tracker foresees the hull, from `from_s` to `to_s` on its clock, which is that
// of `obstacles` too.
[[nodiscard]] bool isAboutToTouch(const vessel::Foreseen& foreseen, double from_s, double to_s,
                                  const vessel::State& state,
                                  const feasibility::Obstacles& obstacles,
                                  const vessel::Hull& hull);

// When a way to rest ends in contact, and how fast the vessel is then: at rest, something comes
// over her.
struct Touch {
  double after_s = std::numeric_limits<double>::infinity();  // none
  double speed_mps = 0.0;

  // Slower at the contact, or later.
  [[nodiscard]] bool milderThan(const Touch& other) const;
};
// Of the exact outline, from `from_s` on and for a while after the trajectory's end: as planned or
// as it lies, whichever is worse. What touches already as it lies is judged as planned alone.
[[nodiscard]] Touch firstTouch(const trajectory::Trajectory& trajectory, double from_s,
                               const feasibility::Obstacles& obstacles,
                               const vessel::Parameters& vessel, const Off& off = {});

}  // namespace otter_nav::stopping
