// Lying still in wind and current. A hull with fixed thrusters has none against what pushes it
// abeam: a heading can be held at rest as far as that sets it aside slowly, and the one along the
// load always, as long as the thrust lasts.
#pragma once

#include <cmath>

#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::vessel {

// Faster is not at rest.
constexpr double kRestMps = 0.25;

// The speed over ground, m/s and to port, of a hull that makes no way along its heading: its sway
// drag balances the load abeam, and the current carries it.
[[nodiscard]] double driftAbeam(const ManoeuvringModel& model, const Disturbance& disturbance,
                                double psi_rad);
// How fast that sets it aside, to whichever side.
[[nodiscard]] inline double setAside(const ManoeuvringModel& model, const Disturbance& disturbance,
                                     double psi_rad) {
  return std::abs(driftAbeam(model, disturbance, psi_rad));
}
// Whether it lies on that heading: set aside by no more than `most_mps`.
[[nodiscard]] inline bool canLie(const ManoeuvringModel& model, const Disturbance& disturbance,
                                 double psi_rad, double most_mps = kRestMps) {
  return setAside(model, disturbance, psi_rad) <= most_mps;
}
// How fast, m/s and to whichever side, a hull on that heading falls off a motion over ground that
// is asked of it: its sway drag balances what that motion lacks of force abeam. A hull that is
// carried as planned doesn't.
[[nodiscard]] double setOff(const ManoeuvringModel& model, const Disturbance& disturbance,
                            double psi_rad, double yaw_rate_radps, const Eigen::Vector2d& velocity,
                            const Eigen::Vector2d& acceleration);
// The heading on which the whole load comes from ahead, found from the one that meets the load as
// it is on `psi_rad`; `psi_rad` itself without any load.
[[nodiscard]] double headingIntoLoad(const ManoeuvringModel& model, const Disturbance& disturbance,
                                     double psi_rad);
// Whether what pushes the resting hull, bow to it, gives a path its heading by itself (w in
// vessel/inverse_dynamics.hpp): it can begin and end there without a turn on the spot. Not where
// wind loads turn with the hull.
[[nodiscard]] bool isFirmLoad(const Parameters& vessel, const Disturbance& disturbance);
// The thrust ahead that holds the hull at rest there, N; negative is astern.
[[nodiscard]] double surgeAtRest(const ManoeuvringModel& model, const Disturbance& disturbance,
                                 double psi_rad);

}  // namespace otter_nav::vessel
