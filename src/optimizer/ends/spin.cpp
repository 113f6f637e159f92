#include <algorithm>
#include <cmath>

#include "optimizer/ends/turn_profile.hpp"
#include "otter_nav/base/parts.hpp"
#include "otter_nav/optimizer/ends.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kShortestS = 1e-6;

struct Turn {
  TurnProfile profile;
  double lag_s;
};

Turn turnBy(double turn_rad, const vessel::Parameters& vessel, const SpinLimits& limits) {
  const vessel::Thrusters& t = vessel.thrusters;
  const double moment =
      2.0 * t.lever_arm_m * limits.thrust_share * std::min(t.ahead_max_n, t.astern_max_n);
  const vessel::TurnLaw law = vessel::turnLaw(vessel, moment);
  return {turnToRest(std::abs(turn_rad), law.r_full, limits.yaw_rate_max_radps, law.lag_s,
                     limits.ramp_s),
          law.lag_s};
}

vessel::FlatPoint headingPoint(const Eigen::Vector4d& turned, double psi_start_rad, double sign) {
  vessel::FlatPoint z;
  z.position.x() = psi_start_rad + sign * turned[0];
  z.velocity.x() = sign * turned[1];
  z.acceleration.x() = sign * turned[2];
  z.jerk.x() = sign * turned[3];
  return z;
}

}  // namespace

double spinDuration(double turn_rad, const vessel::Parameters& vessel, const SpinLimits& limits) {
  return turnBy(turn_rad, vessel, limits).profile.end();
}

void appendSpin(const Eigen::Vector2d& position, double psi_start_rad, double turn_rad,
                const vessel::Parameters& vessel, const SpinLimits& limits,
                std::vector<trajectory::Piece>& pieces) {
  const auto [profile, lag_s] = turnBy(turn_rad, vessel, limits);
  const double sign = turn_rad < 0.0 ? -1.0 : 1.0;
  const std::vector<double> joints = profile.joints();
  for (std::size_t k = 0; k + 1 < joints.size(); ++k) {
    const double length_s = joints[k + 1] - joints[k];
    const int count = partsOf(length_s, lag_s);
    const double step = length_s / count;
    for (int i = 0; i < count && length_s > kShortestS; ++i) {
      const double from = joints[k] + step * i;
      const double within = from + 0.5 * step;
      trajectory::Piece spin;
      spin.kind = trajectory::PieceKind::kSpin;
      spin.duration_s = step;
      spin.position.col(0) = position;
      spin.heading = trajectory::hermitePiece(
                         headingPoint(profile.at(from, within), psi_start_rad, sign),
                         headingPoint(profile.at(from + step, within), psi_start_rad, sign), step)
                         .position.row(0);
      pieces.push_back(spin);
    }
  }
}

}  // namespace otter_nav::optimizer
