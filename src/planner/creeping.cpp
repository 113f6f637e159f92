#include "planner/creeping.hpp"

#include <algorithm>
#include <utility>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/optimizer/ends.hpp"
#include "otter_nav/trajectory/straight_leg.hpp"

namespace otter_nav::planner {
namespace {

constexpr double kThrustShare = 0.6;  // of the limits'
constexpr double kSpeedMps = 0.8;     // at most, half-way of a long leg
constexpr double kYawRateRadps = 0.5;
constexpr double kSamePlaceM = 1e-6;

}  // namespace

trajectory::Trajectory creepAlong(const std::vector<vessel::Pose>& poses,
                                  const vessel::Parameters& vessel,
                                  const feasibility::SafetyLimits& limits) {
  optimizer::SpinLimits spin;
  spin.thrust_share = kThrustShare * limits.thrust_share;
  spin.yaw_rate_max_radps = std::min(kYawRateRadps, limits.yaw_rate_max_radps);
  feasibility::SafetyLimits slow = limits;
  slow.thrust_share = kThrustShare * limits.thrust_share;
  slow.speed_max_mps = std::min(kSpeedMps, limits.speed_max_mps);
  const optimizer::StopAndSpin stops(vessel, spin, slow);
  std::vector<trajectory::Piece> pieces;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Eigen::Vector2d leg = poses[i].position - poses[i - 1].position;
    if (leg.norm() < kSamePlaceM) {
      optimizer::appendSpin(poses[i - 1].position, poses[i - 1].psi_rad,
                            poses[i].psi_rad - poses[i - 1].psi_rad, vessel, spin, pieces);
    } else {
      const double ahead_m = leg.dot(unitVector(poses[i].psi_rad));
      pieces.push_back(trajectory::straightLeg(poses[i - 1].position, poses[i].psi_rad, ahead_m,
                                               stops.legDuration(leg.norm())));
    }
  }
  return trajectory::Trajectory(std::move(pieces));
}

}  // namespace otter_nav::planner
