#include "ways.hpp"

#include <array>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/optimizer/spin.hpp"

namespace otter_nav::planner {
namespace {

using trajectory::Piece;
using vessel::FlatPoint;

constexpr double kLaunchM = 3.0;
constexpr double kLaunchSpeedShare = 0.4;  // of the top speed, at the launch's end

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

// z(t / slowdown): the same way, each derivative smaller by another power.
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
// their part along the way is kept, so that these stay straight.
std::vector<Piece> smoothed(const std::vector<Piece>& way, const Eigen::Vector2d& start_jerk) {
  const std::size_t last = way.size() - 1;
  std::vector<FlatPoint> knots(way.size() + 1);
  knots.front() = way.front().flat(0.0);
  knots.front().jerk = start_jerk;
  knots.back() = way.back().flat(way.back().duration_s);
  const bool launched = atRest(knots.front());
  for (std::size_t i = 1; i <= last; ++i) {
    const FlatPoint before = way[i - 1].flat(way[i - 1].duration_s);
    knots[i] = way[i].flat(0.0);
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
        straight ? straightPiece(knots[i], knots[i + 1], moving.normalized(), way[i].duration_s)
                 : trajectory::hermitePiece(knots[i], knots[i + 1], way[i].duration_s));
  }
  return pieces;
}

double course(const Eigen::Vector2d& v) {
  return std::atan2(v.y(), v.x());
}

trajectory::Trajectory assemble(const std::vector<Piece>& smooth, double slowdown,
                                const trajectory::Boundary& start, const trajectory::Boundary& goal,
                                const vessel::Parameters& vessel) {
  std::vector<Piece> pieces;
  const optimizer::SpinLimits spin;
  if (trajectory::atRest(start)) {
    const Piece& first = smooth.front();
    const double psi = course(first.flat(first.duration_s).velocity);
    optimizer::appendSpin(start.flat.position, start.psi_rad, wrapAngle(psi - start.psi_rad),
                          vessel, spin, pieces);
  }
  for (const Piece& piece : smooth) {
    pieces.push_back(slowed(piece, slowdown));
  }
  const double psi = course(smooth.back().flat(0.0).velocity);
  optimizer::appendSpin(goal.flat.position, psi, wrapAngle(goal.psi_rad - psi), vessel, spin,
                        pieces);
  return trajectory::Trajectory(std::move(pieces));
}

}  // namespace

double trajectoryCost(const trajectory::Trajectory& trajectory, double sigma) {
  double cost = 0.0;
  for (const Piece& piece : trajectory.pieces()) {
    cost += pieceCost(piece, sigma);
  }
  return cost;
}

Launch launchFrom(const Eigen::Vector2d& position, const Eigen::Vector2d& direction,
                  double top_speed_mps) {
  FlatPoint rest;
  rest.position = position;
  FlatPoint end;
  end.position = position + kLaunchM * direction;
  end.velocity = kLaunchSpeedShare * top_speed_mps * direction;
  Launch launch;
  launch.root.position = end.position;
  launch.root.velocity = end.velocity;
  launch.piece = trajectory::hermitePiece(rest, end, 2.0 * kLaunchM / end.velocity.norm());
  return launch;
}

Launch stopAt(const Eigen::Vector2d& position, const Eigen::Vector2d& direction,
              double top_speed_mps) {
  Launch stop = launchFrom(position, -direction, top_speed_mps);
  FlatPoint rest;
  rest.position = position;
  const FlatPoint moving = reversed(stop.piece.flat(stop.piece.duration_s));
  stop.root.velocity = moving.velocity;
  stop.piece = trajectory::hermitePiece(moving, rest, stop.piece.duration_s);
  return stop;
}

Result<trajectory::Trajectory> closeWay(const std::vector<Piece>& way,
                                        const trajectory::Boundary& start,
                                        const trajectory::Boundary& goal,
                                        const map::DistanceField& field,
                                        const vessel::Parameters& vessel,
                                        const feasibility::CheckOptions& check) {
  constexpr std::array<double, 10> kSlowdown = {1.0, 1.05, 1.1, 1.2, 1.4, 1.7, 2.1, 2.6, 3.2, 4.0};
  const std::vector<Piece> smooth = smoothed(way, start.flat.jerk);
  std::string reason;
  for (const double slowdown : kSlowdown) {
    if (slowdown > 1.0 && !trajectory::atRest(start)) {
      break;
    }
    trajectory::Trajectory trajectory = assemble(smooth, slowdown, start, goal, vessel);
    const auto verification = feasibility::verify(trajectory, field, vessel, start, goal, check);
    if (verification.ok) {
      return trajectory;
    }
    reason = verification.reason;
  }
  return failure("the trees' way can't be made sound: " + reason);
}

}  // namespace otter_nav::planner
