// Turning on the spot, nearly as fast as the thrusters allow.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

struct SpinLimits {
  double thrust_share = 0.9;  // of the weaker of ahead and astern, on both sides
  double yaw_rate_max_radps = 1.8;
  double ramp_s = 0.12;  // in which the moment goes from one value to the next
};

// Duration, s, of a spin by `turn_rad`.
[[nodiscard]] double spinDuration(double turn_rad, const vessel::Parameters& vessel,
                                  const SpinLimits& limits);

// Appends the pieces of a spin by `turn_rad` from rest to rest: full moment up to the yaw rate's
// limit, steady, full moment back (the time-optimal turn of m2 r' = tau - d3 r), averaged over
// `ramp_s` so that the moment is continuous. Each of its exponentials is met by pieces of degree 7
// with heading, yaw rate and its two derivatives.
void appendSpin(const Eigen::Vector2d& position, double psi_start_rad, double turn_rad,
                const vessel::Parameters& vessel, const SpinLimits& limits,
                std::vector<trajectory::Piece>& pieces);

}  // namespace otter_nav::optimizer
