#include "tracker/trajectory_check.hpp"

#include <cmath>
#include <string>

namespace otter_nav::tracker {
namespace {

constexpr double kJointGapM = 0.05;
constexpr double kJointGapMps = 0.1;

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

}  // namespace

Status checkTrajectory(const trajectory::Trajectory& trajectory) {
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
    if (i > 0) {
      if (Status status = checkJoint(pieces[i - 1], p, i); !status) {
        return status;
      }
    }
  }
  return {};
}

}  // namespace otter_nav::tracker
