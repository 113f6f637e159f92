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

// A vessel that is faster than the limit where the plan starts: it has to slow down by this rate.
struct SlowingDown {
  double start_mps = 0.0;
  double per_s = 0.0;
  double from_s = 0.0;

  // The limit at a time from the plan's start, of one that is `usual_mps` later.
  [[nodiscard]] double limitAt(double time_s, double usual_mps) const {
    return start_mps <= usual_mps
               ? usual_mps
               : std::max(usual_mps, start_mps * std::exp(-per_s * std::max(0.0, time_s - from_s)));
  }
};

// Preferred beside the hull in narrow water, m: what waves set it aside by is made good in seconds.
constexpr double kPreferredBesideM = 0.3;

// Until they are made from a vessel they allow nothing to move.
struct SafetyLimits {
  // Of the hull's centre from everything occupied, m. The discs that cover the hull keep
  // `hull_margin_m` besides.
  double clearance_m = 0.0;
  double hull_margin_m = 0.0;
  // Kept by the hull's centre where it costs little; 0: no more than `clearance_m`.
  double preferred_clearance_m = 0.0;
  vessel::Hull hull;
  // Of each thruster's limits; the rest is for control, wind and current.
  double thrust_share = 0.0;
  double speed_max_mps = 0.0;  // over ground
  double yaw_rate_max_radps = 0.0;
  // What the thrusters work against besides, all along: every demand of a plan is made and verified
  // with it (docs/planner.md).
  vessel::Disturbance disturbance;
  // A load that the plan is not made with. Under way the tracked hull leans into it, the more
  // the less pushes it along its path; near obstacles it keeps clear in that attitude too
  // (feasibility/lean.hpp).
  vessel::Disturbance felt;
  // How far these set a hull aside that loses its heading: nothing may lie there
  // (feasibility/lee_shore.hpp). Earth frame, m.
  Eigen::Vector2d drift_m = Eigen::Vector2d::Zero();
  SlowingDown slowing;

  // At a time from the plan's start.
  [[nodiscard]] double speedMaxAt(double time_s) const {
    return slowing.limitAt(time_s, speed_max_mps);
  }
  [[nodiscard]] double speedMaxEver() const { return std::max(speed_max_mps, slowing.start_mps); }

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

// `share` of what sway drag holds |w| at, at the speed limit, N.
[[nodiscard]] double headingForceAtSpeed(const vessel::Parameters& vessel,
                                         const SafetyLimits& limits, double share);
// The least |w| that holds a heading where the path turns, N: `share` of both thrusters' force
// ahead, but no more than a part of that.
[[nodiscard]] double leastHeadingForce(const vessel::Parameters& vessel, const SafetyLimits& limits,
                                       double share);
// What plans with limits.thrust_share sail where nothing limits their speed.
[[nodiscard]] double usualSpeed(const vessel::Parameters& vessel, const SafetyLimits& limits);
// The speed limit over that, at most 1.
[[nodiscard]] double speedShare(const vessel::Parameters& vessel, const SafetyLimits& limits);

}  // namespace otter_nav::feasibility
