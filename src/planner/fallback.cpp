#include "planner/fallback.hpp"

#include <array>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/optimizer/ends.hpp"

namespace otter_nav::planner {
namespace {

using trajectory::Piece;
using vessel::FlatPoint;

constexpr double kLaunchM = 3.0;
// Of the limits, in spins.
constexpr double kSpinThrustShare = 0.93;
constexpr double kSpinRateShare = 0.9;
// At the launch's end: of the speed usual, and of the speed limit at most.
constexpr double kLaunchSpeedShare = 0.41;
constexpr double kLaunchLimitShare = 0.85;

FlatPoint reversed(const FlatPoint& z) {
  FlatPoint r = z;
  r.velocity = -z.velocity;
  r.jerk = -z.jerk;
  return r;
}

// A piece exactly along `direction`: its coefficients are numbers times that direction, so that
// rounding does not turn the heading where |w| passes through zero.
Piece straightPiece(const FlatPoint& from, const FlatPoint& to, const Eigen::Vector2d& direction,
                    double duration_s) {
  const auto along = [&](const FlatPoint& z) {
    FlatPoint s;
    s.position.x() = direction.dot(z.position - from.position);
    s.velocity.x() = direction.dot(z.velocity);
    s.acceleration.x() = direction.dot(z.acceleration);
    s.jerk.x() = direction.dot(z.jerk);
    return s;
  };
  Piece piece = trajectory::hermitePiece(along(from), along(to), duration_s);
  const Eigen::Matrix<double, 1, trajectory::kCoefficients> numbers = piece.position.row(0);
  piece.position = direction * numbers;
  piece.position.col(0) = from.position;
  return piece;
}

// z(t / slowdown): the same path, each derivative smaller by another power.
Piece slowed(const Piece& piece, double slowdown) {
  Piece slow = piece;
  slow.duration_s = slowdown * piece.duration_s;
  double power = 1.0;
  for (int k = 0; k < trajectory::kCoefficients; ++k) {
    slow.position.col(k) *= power;
    power /= slowdown;
  }
  return slow;
}

bool atRest(const FlatPoint& z) {
  return z.velocity.norm() < 1e-6;
}

// Jerks on both sides of each joint averaged, the first one given; next to launch and stop only
// their part along the path is kept, so that these stay straight.
std::vector<Piece> smoothed(const std::vector<Piece>& path, const Eigen::Vector2d& start_jerk) {
  const std::size_t last = path.size() - 1;
  std::vector<FlatPoint> knots(path.size() + 1);
  knots.front() = path.front().flat(0.0);
  knots.front().jerk = start_jerk;
  knots.back() = path.back().flat(path.back().duration_s);
  const bool launched = atRest(knots.front());
  for (std::size_t i = 1; i <= last; ++i) {
    const FlatPoint before = path[i - 1].flat(path[i - 1].duration_s);
    knots[i] = path[i].flat(0.0);
    knots[i].jerk = 0.5 * (before.jerk + knots[i].jerk);
    if ((launched && i == 1) || i == last) {
      const Eigen::Vector2d along = knots[i].velocity.normalized();
      knots[i].acceleration.setZero();
      knots[i].jerk = along * along.dot(knots[i].jerk);
    }
  }
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i <= last; ++i) {
    const bool straight = (launched && i == 0) || i == last;
    const Eigen::Vector2d& moving = i == 0 ? knots[1].velocity : knots[i].velocity;
    pieces.push_back(
        straight ? straightPiece(knots[i], knots[i + 1], moving.normalized(), path[i].duration_s)
                 : trajectory::hermitePiece(knots[i], knots[i + 1], path[i].duration_s));
  }
  return pieces;
}

trajectory::Trajectory assemble(const std::vector<Piece>& smooth, double slowdown,
                                const trajectory::Boundary& start, const trajectory::Boundary& goal,
                                const vessel::Parameters& vessel,
                                const feasibility::SafetyLimits& limits) {
  std::vector<Piece> pieces;
  optimizer::SpinLimits spin;
  spin.thrust_share = kSpinThrustShare * limits.thrust_share;
  spin.yaw_rate_max_radps = kSpinRateShare * limits.yaw_rate_max_radps;
  if (trajectory::atRest(start)) {
    const Piece& first = smooth.front();
    const double psi = angleOf(first.flat(first.duration_s).velocity);
    optimizer::appendSpin(start.flat.position, start.psi_rad, wrapAngle(psi - start.psi_rad),
                          vessel, spin, pieces);
  }
  for (const Piece& piece : smooth) {
    pieces.push_back(slowed(piece, slowdown));
  }
  const double psi = angleOf(smooth.back().flat(0.0).velocity);
  optimizer::appendSpin(goal.flat.position, psi, wrapAngle(goal.psi_rad - psi), vessel, spin,
                        pieces);
  return trajectory::Trajectory(std::move(pieces));
}

}  // namespace

double launchSpeed(const vessel::Parameters& vessel, const feasibility::SafetyLimits& limits) {
  return std::min(kLaunchSpeedShare * feasibility::usualSpeed(vessel, limits),
                  kLaunchLimitShare * limits.speed_max_mps);
}

Launch launchFrom(const Eigen::Vector2d& position, const Eigen::Vector2d& direction,
                  double speed_mps) {
  FlatPoint rest;
  rest.position = position;
  FlatPoint end;
  end.position = position + kLaunchM * direction;
  end.velocity = speed_mps * direction;
  Launch launch;
  launch.root.position = end.position;
  launch.root.velocity = end.velocity;
  launch.piece = trajectory::hermitePiece(rest, end, 2.0 * kLaunchM / end.velocity.norm());
  return launch;
}

Launch stopAt(const Eigen::Vector2d& position, const Eigen::Vector2d& direction, double speed_mps) {
  Launch stop = launchFrom(position, -direction, speed_mps);
  FlatPoint rest;
  rest.position = position;
  const FlatPoint moving = reversed(stop.piece.flat(stop.piece.duration_s));
  stop.root.velocity = moving.velocity;
  stop.piece = trajectory::hermitePiece(moving, rest, stop.piece.duration_s);
  return stop;
}

Result<trajectory::Trajectory> closePath(const std::vector<Piece>& path,
                                         const trajectory::Boundary& start,
                                         const trajectory::Boundary& goal,
                                         const feasibility::Obstacles& obstacles,
                                         const vessel::Parameters& vessel,
                                         const feasibility::SafetyLimits& limits) {
  constexpr std::array<double, 10> kSlowdown = {1.0, 1.05, 1.1, 1.2, 1.4, 1.7, 2.1, 2.6, 3.2, 4.0};
  const std::vector<Piece> smooth = smoothed(path, start.flat.jerk);
  std::string reason;
  for (const double slowdown : kSlowdown) {
    if (slowdown > 1.0 && !trajectory::atRest(start)) {
      break;
    }
    trajectory::Trajectory trajectory = assemble(smooth, slowdown, start, goal, vessel, limits);
    const auto verification =
        feasibility::verify(trajectory, obstacles, vessel, start, goal, limits);
    if (verification.ok) {
      return trajectory;
    }
    reason = verification.reason;
  }
  return failure("the trees' path can't be made feasible: " + reason);
}

}  // namespace otter_nav::planner
