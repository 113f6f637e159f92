// Which headings a vessel can keep in wind and current, at rest or on a course, and what that takes
// of its thrusters.
//
// Steady means r = r' = 0 and a constant velocity over ground. The manoeuvring model's sway
// equation, in which no thruster appears, then says which headings are possible; its surge and yaw
// equations give the thrusts (vessel/motion_law.hpp).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::vessel {

// A force over the steady speed v that it keeps up against drag: d v + q v |v| = force.
[[nodiscard]] inline double steadyDrag(double linear, double quadratic, double force) {
  return 0.5 * (linear + std::sqrt(linear * linear + 4.0 * quadratic * force));
}

struct SteadyMotion {
  double psi_rad = 0.0;
  Thrusts thrusts = Thrusts::Zero();
  double thrust_share = 0.0;  // of the limits, ahead or astern, of the thruster nearer to its own
  double sway_n = 0.0;        // to port, that would be needed and no thruster gives

  // What is left of the thrusters for gusts and control; negative: can't be kept.
  [[nodiscard]] double margin() const { return 1.0 - thrust_share; }
};

// Moving with `velocity` over ground (m/s, earth frame; zero at rest) on a given heading.
[[nodiscard]] SteadyMotion steadyOn(double psi_rad, const Eigen::Vector2d& velocity,
                                    const Parameters& vessel, const Disturbance& disturbance);

// All headings on which that motion needs no force from the side, the nearest to `psi_near_rad`
// first: at rest about two (bow and stern to what pushes), on a course the crab angle and its like
// astern. In calm water every heading will do at rest, and `psi_near_rad` is the answer.
[[nodiscard]] std::vector<SteadyMotion> steadyHeadings(const Eigen::Vector2d& velocity,
                                                       double psi_near_rad,
                                                       const Parameters& vessel,
                                                       const Disturbance& disturbance);

}  // namespace otter_nav::vessel
