#include "tracker/trajectory_check.hpp"

#include "otter_nav/base/parts.hpp"
#include "otter_nav/base/text.hpp"
#include "otter_nav/trajectory/joint.hpp"

namespace otter_nav::tracker {
namespace {

constexpr trajectory::Gap kLargest = {0.05, 0.1};
constexpr double kTooFast = 1.25;  // times the top speed, over ground: a current may help
constexpr double kStepS = 0.05;

Status checkSpeed(const trajectory::Piece& p, std::size_t i, double top_speed_mps) {
  const double most = kTooFast * top_speed_mps;
  const int steps = partsOf(p.duration_s, kStepS);
  for (int k = 0; k <= steps; ++k) {
    const double t = p.duration_s * k / steps;
    const double speed = p.flat(t).velocity.norm();
    if (speed > most) {
      return failure(text("pieces[%zu]: %g m/s at %g s, the vessel can %g m/s (at most %g)", i,
                          speed, t, top_speed_mps, most));
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
  Status status = trajectory::checkPieces(pieces, kLargest);
  for (std::size_t i = 0; status && i < pieces.size(); ++i) {
    status = checkSpeed(pieces[i], i, top_speed_mps);
  }
  return status;
}

}  // namespace otter_nav::tracker
