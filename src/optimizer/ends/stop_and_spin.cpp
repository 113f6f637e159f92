#include "optimizer/ends/stop_and_spin.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kSamePointM = 0.02;
constexpr double kStandstillS = 0.1;  // a trajectory that has nothing to do lasts this long
constexpr double kLeastLegS = 1.2;    // a shorter leg would jerk the hull for nothing
constexpr double kSameHeadingRad = 1e-9;

// Peaks over [0, 1] of the degree-7 step s(x) = 35 x^4 - 84 x^5 + 70 x^6 - 20 x^7 (rest to rest,
// no acceleration or jerk at the ends): s' and s''.
constexpr double kPeakSpeed = 35.0 / 16.0;
constexpr double kPeakAcceleration = 7.5132;

}  // namespace

// A piece of degree 7, rest to rest, as slow as speed and thrust ask for: d1 v + m1 a is bounded
// by the sum of both peaks.
void StopAndSpin::appendStraight(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                 std::vector<trajectory::Piece>& pieces) const {
  const double length = (to - from).norm();
  const Eigen::Vector2d direction = (to - from) / length;
  const vessel::PaperModel& m = vessel_.paper;
  const double force = 0.95 * safety_.thrust_share * 2.0 *
                       std::min(vessel_.thrusters.ahead_max_n, vessel_.thrusters.astern_max_n);
  double duration = std::max(kLeastLegS, kPeakSpeed * length / (0.95 * safety_.speed_max_mps));
  // d1 peak_v / T + m1 peak_a / T^2 <= force
  const double b = m.d1_kgps * kPeakSpeed * length;
  const double c = m.m1_kg * kPeakAcceleration * length;
  duration = std::max(duration, (b + std::sqrt(b * b + 4.0 * force * c)) / (2.0 * force));
  vessel::FlatPoint start;
  vessel::FlatPoint end;
  end.position.x() = length;
  trajectory::Piece piece = trajectory::hermitePiece(start, end, duration);
  const Eigen::Matrix<double, 1, trajectory::kCoefficients> s = piece.position.row(0);
  piece.position = direction * s;
  piece.position.col(0) = from;
  pieces.push_back(piece);
}

trajectory::Trajectory StopAndSpin::follow(const std::vector<Eigen::Vector2d>& path,
                                           const trajectory::Boundary& start,
                                           const trajectory::Boundary& goal) const {
  std::vector<trajectory::Piece> pieces;
  double psi = start.psi_rad;
  Eigen::Vector2d at = start.flat.position;
  const auto turnTo = [&](double psi_next) {
    const double turn = wrapAngle(psi_next - psi);
    if (std::abs(turn) > kSameHeadingRad) {
      appendSpin(at, psi, turn, vessel_, spin_, pieces);
    }
    psi += turn;
  };
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Eigen::Vector2d& next = i + 1 < path.size() ? path[i] : goal.flat.position;
    const Eigen::Vector2d leg = next - at;
    if (leg.norm() < kSamePointM && i + 1 < path.size()) {
      continue;
    }
    if (leg.norm() > 1e-6) {
      turnTo(std::atan2(leg.y(), leg.x()));
      appendStraight(at, next, pieces);
      at = next;
    }
  }
  turnTo(goal.psi_rad);
  if (pieces.empty()) {
    pieces.push_back(trajectory::spinPiece(at, psi, psi, kStandstillS));
  }
  return trajectory::Trajectory(std::move(pieces));
}

}  // namespace otter_nav::optimizer
