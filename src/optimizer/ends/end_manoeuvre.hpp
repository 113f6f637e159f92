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
#include <vector>

#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

struct ManoeuvreLimits {
  double thrust_share = 0.94;  // of each thruster's limits
  double yaw_rate_max_radps = 1.8;
  double speed_max_mps = 1e3;
  double ramp_s = 0.12;       // in which the moment goes from one value to the next
  double drift_mps = 0.3;     // speed left when the arrival's turn begins; 0: it turns at rest
  double surge_ramp_s = 0.3;  // to full ahead, and from full astern to nothing
  double brake_ramp_s = 0.4;  // from ahead to full astern
  double astern_share = 0.9;  // of the force, while braking
  bool settle = false;        // the launch ends its turn before it goes ahead
  vessel::Disturbance disturbance;  // under which the hull drifts while it turns and brakes
};

struct Manoeuvre {
  std::vector<trajectory::Piece> pieces;
  vessel::FlatPoint joint;  // where it meets the rest of the path, under way
  double duration_s = 0.0;
};

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
