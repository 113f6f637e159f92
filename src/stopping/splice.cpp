#include "otter_nav/stopping/splice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "otter_nav/stopping/braking.hpp"

namespace otter_nav::stopping {
namespace {

using trajectory::kCoefficients;
using trajectory::kDegree;
using trajectory::Piece;
using trajectory::Trajectory;

double binomial(int n, int k) {
  double value = 1.0;
  for (int i = 1; i <= k; ++i) {
    value *= static_cast<double>(n - k + i) / i;
  }
  return value;
}

// The same polynomial with its time counted from `t`.
template <int Rows>
void shift(Eigen::Matrix<double, Rows, kCoefficients>& c, double t) {
  // Repeated synthetic division by (x - t).
  for (int k = 0; k < kDegree; ++k) {
    for (int j = kDegree - 1; j >= k; --j) {
      c.col(j) += t * c.col(j + 1);
    }
  }
}

// No velocity's magnitude on the piece is above that of its Bernstein control points.
double speedBound(const Piece& piece) {
  constexpr int kVelocityDegree = kDegree - 1;
  double bound = 0.0;
  for (int j = 0; j <= kVelocityDegree; ++j) {
    Eigen::Vector2d control = Eigen::Vector2d::Zero();
    double power = 1.0;
    for (int k = 0; k <= j; ++k) {
      control += binomial(j, k) / binomial(kVelocityDegree, k) * power * (k + 1) *
                 piece.position.col(k + 1);
      power *= piece.duration_s;
    }
    bound = std::max(bound, control.norm());
  }
  return bound;
}

}  // namespace

Conflict firstConflict(const Trajectory& trajectory, double from_s,
                       const feasibility::Obstacles& obstacles, double clearance_m) {
  constexpr double kLeastStepM = 0.05;
  if (trajectory.empty()) {
    return {};
  }
  for (std::size_t i = trajectory.pieceAt(from_s); i < trajectory.pieces().size(); ++i) {
    const Piece& piece = trajectory.pieces()[i];
    const double bound = speedBound(piece) + obstacles.rateBound();
    double t = std::clamp(from_s - trajectory.startOf(i), 0.0, piece.duration_s);
    while (true) {
      const Eigen::Vector2d position = piece.flat(t).position;
      const double clearance = obstacles.clearance(position, trajectory.startOf(i) + t);
      if (clearance < clearance_m) {
        return {true, trajectory.startOf(i) + t, position, clearance};
      }
      if (t >= piece.duration_s || bound <= 0.0) {
        break;
      }
      t = std::min(piece.duration_s, t + std::max(kLeastStepM, clearance - clearance_m) / bound);
    }
  }
  return {};
}

Trajectory remainder(const Trajectory& trajectory, double at_s) {
  if (trajectory.empty()) {
    return {};
  }
  const std::size_t first = trajectory.pieceAt(at_s);
  const auto begin = trajectory.pieces().begin() + static_cast<std::ptrdiff_t>(first);
  std::vector<Piece> pieces(begin, trajectory.pieces().end());
  const double into = std::clamp(at_s - trajectory.startOf(first), 0.0, pieces.front().duration_s);
  shift<2>(pieces.front().position, into);
  shift<1>(pieces.front().heading, into);
  pieces.front().duration_s -= into;
  if (pieces.front().duration_s <= 0.0) {
    pieces.erase(pieces.begin());
  }
  return Trajectory(std::move(pieces));
}

trajectory::TimedTrajectory splice(const trajectory::TimedTrajectory& sailed, double now_s,
                                   const trajectory::TimedTrajectory& next) {
  constexpr double kShortestS = 1e-6;
  const Trajectory& old = sailed.trajectory;
  const double joint = sailed.elapsed(next.start_time_s);
  std::vector<Piece> pieces;
  const std::size_t first = old.pieceAt(sailed.elapsed(now_s));
  for (std::size_t i = first; i < old.pieces().size() && old.startOf(i) < joint; ++i) {
    Piece piece = old.pieces()[i];
    piece.duration_s = std::min(piece.duration_s, joint - old.startOf(i));
    if (piece.duration_s > kShortestS) {
      pieces.push_back(piece);
    }
  }
  const double start = pieces.empty() ? joint : old.startOf(first);
  const std::vector<Piece>& later = next.trajectory.pieces();
  pieces.insert(pieces.end(), later.begin(), later.end());
  return {Trajectory(std::move(pieces)), sailed.start_time_s + start};
}

}  // namespace otter_nav::stopping
