#include "otter_nav/ros/trajectories.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/parts.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/trajectory/joint.hpp"

namespace otter_nav::ros_bridge {
namespace {

constexpr std::size_t kMaxPieces = 10000;
constexpr double kMaxPieceDurationS = 3600.0;
constexpr trajectory::Gap kLargest = {1e-3, 1e-3};

using trajectory::kCoefficients;
using trajectory::Piece;
using trajectory::PieceKind;

Result<Piece> toPiece(const TrajectoryPiece& message) {
  if (message.kind != TrajectoryPiece::SAIL && message.kind != TrajectoryPiece::SPIN) {
    return failure("kind " + std::to_string(message.kind) + " is neither SAIL nor SPIN");
  }
  if (message.duration > kMaxPieceDurationS) {
    return failure("duration is more than " + std::to_string(kMaxPieceDurationS) + " s");
  }
  Piece piece;
  piece.kind = message.kind == TrajectoryPiece::SAIL ? PieceKind::kSail : PieceKind::kSpin;
  piece.duration_s = message.duration;
  for (int k = 0; k < kCoefficients; ++k) {
    const auto i = static_cast<std::size_t>(k);
    piece.position.col(k) << message.x[i], message.y[i];
    piece.heading[k] = message.heading[i];
  }
  return piece;
}

TrajectoryPiece toMessage(const Piece& piece) {
  TrajectoryPiece message;
  message.kind = piece.kind == PieceKind::kSail ? TrajectoryPiece::SAIL : TrajectoryPiece::SPIN;
  message.duration = piece.duration_s;
  for (int k = 0; k < kCoefficients; ++k) {
    const auto i = static_cast<std::size_t>(k);
    message.x[i] = piece.position(0, k);
    message.y[i] = piece.position(1, k);
    message.heading[i] = piece.heading[k];
  }
  return message;
}

}  // namespace

Trajectory toMessage(const trajectory::TimedTrajectory& timed, std::uint32_t id,
                     const vessel::Pose& goal, const std::string& frame,
                     const vessel::Parameters& vessel) {
  const trajectory::Trajectory& trajectory = timed.trajectory;
  Trajectory message;
  message.header.frame_id = frame;
  message.header.stamp = toRosTime(timed.start_time_s);
  message.id = id;
  message.speed_max = std::isfinite(timed.speed_max_mps) ? timed.speed_max_mps : 0.0;
  message.rolled_out = static_cast<std::uint8_t>(timed.rolled_out);
  message.goal = toPose(goal);
  if (!trajectory.empty()) {
    const vessel::State start = trajectory.sample(0.0, vessel).state;
    std::copy(start.begin(), start.end(), message.start_state.begin());
  }
  message.pieces.reserve(trajectory.pieces().size());
  for (const Piece& piece : trajectory.pieces()) {
    message.pieces.push_back(toMessage(piece));
  }
  return message;
}

Result<trajectory::TimedTrajectory> toTrajectory(const Trajectory& message,
                                                 const std::string& frame) {
  if (const Status status = checkFrame(message.header.frame_id, frame); !status) {
    return failure(status.error().message);
  }
  if (message.header.stamp.isZero()) {
    return failure("header.stamp, the start time, is zero");
  }
  if (!std::isfinite(message.speed_max) || message.speed_max < 0.0) {
    return failure("speed_max is " + std::to_string(message.speed_max) +
                   " m/s, has to be positive, or 0 for none");
  }
  if (message.pieces.size() > kMaxPieces) {
    return failure("holds " + std::to_string(message.pieces.size()) + " pieces, at most " +
                   std::to_string(kMaxPieces) + " are allowed");
  }
  std::vector<Piece> pieces;
  pieces.reserve(message.pieces.size());
  for (std::size_t i = 0; i < message.pieces.size(); ++i) {
    Result<Piece> piece = toPiece(message.pieces[i]);
    if (!piece) {
      return failure("pieces[" + std::to_string(i) + "]: " + piece.error().message);
    }
    pieces.push_back(*piece);
  }
  if (const Status status = trajectory::checkPieces(pieces, kLargest); !status) {
    return failure(status.error().message);
  }
  trajectory::TimedTrajectory timed{trajectory::Trajectory(std::move(pieces)),
                                    message.header.stamp.toSec()};
  if (message.speed_max > 0.0) {
    timed.speed_max_mps = message.speed_max;
  }
  timed.rolled_out = message.rolled_out != 0;
  return timed;
}

nav_msgs::Path toPath(const trajectory::Trajectory& trajectory, double start_s, double step_s,
                      const std::string& frame, const vessel::Parameters& vessel) {
  nav_msgs::Path path;
  path.header.frame_id = frame;
  path.header.stamp = toRosTime(start_s);
  if (trajectory.empty()) {
    return path;
  }
  const int steps = partsOf(trajectory.duration(), step_s);
  for (int i = 0; i <= steps; ++i) {
    const double t_s = trajectory.duration() * i / steps;
    const vessel::State state = trajectory.sample(t_s, vessel).state;
    path.poses.push_back(
        toPose({state.head<2>(), state[vessel::kPsi]}, frame, toRosTime(start_s + t_s)));
  }
  return path;
}

}  // namespace otter_nav::ros_bridge
