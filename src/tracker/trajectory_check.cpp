#include "tracker/trajectory_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace otter_nav::tracker {
namespace {

constexpr double kJointGapM = 0.05;
constexpr double kJointGapMps = 0.1;
constexpr double kTooFast = 1.25;  // times the top speed, over ground: a current may help
constexpr double kStepS = 0.05;

std::string piece(std::size_t i) {
  return "trajectory piece " + std::to_string(i);
}

Status checkJoint(const trajectory::Piece& before, const trajectory::Piece& after, std::size_t i) {
  const vessel::FlatPoint a = before.flat(before.duration_s);
  const vessel::FlatPoint b = after.flat(0.0);
  const double gap_m = (a.position - b.position).norm();
  const double gap_mps = (a.velocity - b.velocity).norm();
  if (gap_m > kJointGapM) {
    return failure(piece(i) + " starts " + std::to_string(gap_m) +
                   " m from the end of the one before (at most " + std::to_string(kJointGapM) +
                   ")");
  }
  if (gap_mps > kJointGapMps) {
    return failure(piece(i) + ": velocity jumps by " + std::to_string(gap_mps) + " m/s (at most " +
                   std::to_string(kJointGapMps) + ")");
  }
  return {};
}

Status checkSpeed(const trajectory::Piece& p, std::size_t i, double top_speed_mps) {
  const double most = kTooFast * top_speed_mps;
  const int steps = static_cast<int>(std::ceil(p.duration_s / kStepS));
  for (int k = 0; k <= steps; ++k) {
    const double t = p.duration_s * k / std::max(steps, 1);
    const double speed = p.flat(t).velocity.norm();
    if (speed > most) {
      return failure(piece(i) + ": " + std::to_string(speed) + " m/s at " + std::to_string(t) +
                     " s, the vessel can " + std::to_string(top_speed_mps) + " m/s (at most " +
                     std::to_string(most) + ")");
    }
  }
  return {};
}

}  // namespace

Status checkTrajectory(const trajectory::Trajectory& trajectory, double top_speed_mps) {
  if (trajectory.empty()) {
    return failure("trajectory has no pieces");
  }
  const auto& pieces = trajectory.pieces();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const trajectory::Piece& p = pieces[i];
    if (!std::isfinite(p.duration_s) || p.duration_s <= 0.0) {
      return failure(piece(i) + ": duration is " + std::to_string(p.duration_s) +
                     " s, must be positive");
    }
    if (!p.position.allFinite() || !p.heading.allFinite()) {
      return failure(piece(i) + ": a coefficient is not finite");
    }
    if (Status status = checkSpeed(p, i, top_speed_mps); !status) {
      return status;
    }
    if (i > 0) {
      if (Status status = checkJoint(pieces[i - 1], p, i); !status) {
        return status;
      }
    }
  }
  return {};
}

}  // namespace otter_nav::tracker
