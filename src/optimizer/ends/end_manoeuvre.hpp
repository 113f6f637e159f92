// Getting under way from rest and coming to rest, nearly as fast as the thrusters allow: turning
// and thrust overlap, which the flat output can't express (|w| vanishes at rest and where the
// thrust changes sign). So these manoeuvres are integrated from the model under given thrusts, and
// kept as pieces with a heading of their own (trajectory/piece.hpp).
//
//   launch   full moment on the spot, then full ahead while the yaw rate dies away
//   arrival  full astern down to `drift_mps`, then a turn on the spot while that dies away too
//
// Both are continuous to the third derivative, with continuous moments, and within the limits.
#pragma once

#include <Eigen/Core>

#include "otter_nav/optimizer/ends.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

// From rest at `position`, heading `psi_rad`, turning by `turn_rad` (to the left if positive).
[[nodiscard]] Manoeuvre launch(const Eigen::Vector2d& position, double psi_rad, double turn_rad,
                               const vessel::Parameters& vessel, const ManoeuvreLimits& limits);

// To rest at `position`, heading `psi_rad`, after turning by `turn_rad`. Full astern begins at
// `speed_mps`. With a drift the course before it lies off the bow, to the side it turns to.
[[nodiscard]] Manoeuvre arrival(const Eigen::Vector2d& position, double psi_rad, double turn_rad,
                                double speed_mps, const vessel::Parameters& vessel,
                                const ManoeuvreLimits& limits);

// The length of path, m, that an arrival with `speed_mps` takes, roughly.
[[nodiscard]] double arrivalLength(double speed_mps, const vessel::Parameters& vessel,
                                   const ManoeuvreLimits& limits);

}  // namespace otter_nav::optimizer
