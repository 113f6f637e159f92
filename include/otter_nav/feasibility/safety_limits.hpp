// What a plan must keep to: made once a request from the vessel, the mission and the weather, and
// passed down to guide path, trees, optimizer and verifier. Nobody below has limits of his own:
// what aims at less than a limit takes a share of it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::feasibility {

struct SafetyLimits {
  // Of the hull's centre from everything occupied, m. The discs that cover the hull keep
  // `hull_margin_m` besides.
  double clearance_m = 0.8;
  double hull_margin_m = 0.0;
  vessel::Hull hull;
  // Of each thruster's limits; the rest is for control, wind and current.
  double thrust_share = 0.97;
  double speed_max_mps = 4.9;  // over ground
  double yaw_rate_max_radps = 2.0;
  // What the thrusters work against besides, all along: every demand of a plan is made and verified
  // with it (docs/planner.md).
  vessel::Disturbance disturbance;
  // How far these set a hull aside that loses its heading: nothing may lie there
  // (feasibility/lee_shore.hpp). Earth frame, m.
  Eigen::Vector2d drift_m = Eigen::Vector2d::Zero();
  // A vessel that is faster than that where the plan starts: it has to slow down by this rate.
  double start_speed_mps = 0.0;
  double slowing_per_s = 0.0;
  double slowing_from_s = 0.0;

  // At a time from the plan's start.
  [[nodiscard]] double speedMaxAt(double time_s) const {
    return start_speed_mps <= speed_max_mps
               ? speed_max_mps
               : std::max(speed_max_mps,
                          start_speed_mps *
                              std::exp(-slowing_per_s * std::max(0.0, time_s - slowing_from_s)));
  }
  [[nodiscard]] double speedMaxEver() const { return std::max(speed_max_mps, start_speed_mps); }

  // Of a vessel that may use `thrust_share` of what plans usually take, for instance less in wind:
  // its speed falls with it, as under linear drag.
  [[nodiscard]] static SafetyLimits of(const vessel::Parameters& vessel, double clearance_m,
                                       double thrust_share = 1.0);
  // With room beside the hull: half its beam and what otters take beside theirs.
  [[nodiscard]] static SafetyLimits of(const vessel::Parameters& vessel);
  // No faster than `speed_mps`, less what control needs; 0: as before.
  void limitSpeed(double speed_mps);
  // For a plan that starts at `speed_mps`: above the limit it falls as the drag alone could make
  // it.
  [[nodiscard]] SafetyLimits startingAt(double speed_mps, const vessel::Parameters& vessel) const;
};

// The least |w| that holds a heading where the path turns, N: `share` of both thrusters' force
// ahead, but no more than a part of what holds it at the speed limit.
[[nodiscard]] double leastHeadingForce(const vessel::Parameters& vessel, const SafetyLimits& limits,
                                       double share);
// What plans with limits.thrust_share sail where nothing limits their speed.
[[nodiscard]] double usualSpeed(const vessel::Parameters& vessel, const SafetyLimits& limits);
// The speed limit over that, at most 1.
[[nodiscard]] double speedShare(const vessel::Parameters& vessel, const SafetyLimits& limits);

}  // namespace otter_nav::feasibility
