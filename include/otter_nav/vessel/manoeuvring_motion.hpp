// Motion by the manoeuvring model along headings that are given: what a hull does that is turned so
// and pushed so. The counterpart of InverseDynamics::push for hulls whose sway, yaw drag or
// couplings the paper's five numbers do not hold.
#pragma once

#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::vessel {

// Whether the paper's model will do for plans: the same inertias and no couplings of sway and yaw
// (drags it has as linear ones, and how much sway force a turn feels it leaves to the tracker).
// Otherwise plans are made and verified with the manoeuvring model.
[[nodiscard]] bool paperHolds(const Parameters& vessel);

// Slower than this a plan by the manoeuvring model may have any side of the hull come first: for a
// moment it goes astern, and the heading stays.
constexpr double kWalkingMps = 0.3;

// A heading with its first two derivatives.
struct Swing {
  double psi_rad = 0.0;
  double yaw_rate_radps = 0.0;
  double yaw_acceleration = 0.0;
};

// z'' and z''' of `motion`, whose position and velocity are set, under the thrusters' surge force
// and its rate; nothing but the water and `disturbance` acts abeam (vessel/motion_law.hpp).
void push(const ManoeuvringModel& model, const Disturbance& disturbance, const Swing& swing,
          double surge_n, double surge_rate_nps, FlatPoint& motion);
// z'' alone.
[[nodiscard]] Eigen::Vector2d pushed(const ManoeuvringModel& model, const Disturbance& disturbance,
                                     double psi_rad, double yaw_rate_radps, double surge_n,
                                     const Eigen::Vector2d& velocity);

// A state as a point of a path: heading and yaw rate as they are, surge force to hold the speed or
// `force_max_n`. By the model that plans are made with; by the manoeuvring model the force gives
// the path a heading, as far as the moment that keeps the yaw rate leaves it. Where no thrusters
// within that share of their limits have such a moment, the yaw rate changes.
[[nodiscard]] FlatPoint pathFromState(const State& state, double force_max_n,
                                      const Parameters& vessel, const Disturbance& disturbance);

// How the hull turns on the spot, as m2 r' = M - d3 r: exact for the paper's model. For the other,
// whose drag grows with the square of the rate, the quickest such law that asks for no more than
// `moment_nm` anywhere in a turn up to nearly `r_full` and back.
struct TurnLaw {
  double lag_s;   // m2 / d3
  double r_full;  // the moment over d3, rad/s

  // Until the heading is `angle_rad` from where it was at rest, s.
  [[nodiscard]] double timeTo(double angle_rad) const;
};
[[nodiscard]] TurnLaw turnLaw(const Parameters& vessel, double moment_nm);

}  // namespace otter_nav::vessel
