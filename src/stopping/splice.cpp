#include "otter_nav/stopping/splice.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace otter_nav::stopping {
namespace {

using trajectory::kCoefficients;
using trajectory::kDegree;
using trajectory::Piece;
using trajectory::Trajectory;

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

}  // namespace

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

bool restsBeforeItsEnd(const Trajectory& trajectory) {
  constexpr double kRestMps = 1e-3;
  constexpr double kSetAsideM = 0.3;  // by a turn on the spot
  const auto goesOn = [](const Piece& piece) {
    return piece.kind == trajectory::PieceKind::kSail ||
           (piece.flat(piece.duration_s).position - piece.flat(0.0).position).norm() > kSetAsideM;
  };
  bool under_way = false;
  for (std::size_t i = 0; i + 1 < trajectory.pieces().size(); ++i) {
    const Piece& piece = trajectory.pieces()[i];
    under_way = under_way || piece.flat(0.5 * piece.duration_s).velocity.norm() > kRestMps;
    if (under_way && piece.flat(piece.duration_s).velocity.norm() < kRestMps) {
      // Followed by a turn on the spot alone, which may set the hull aside, it is the arrival.
      const auto rest = trajectory.pieces().begin() + static_cast<std::ptrdiff_t>(i) + 1;
      if (std::any_of(rest, trajectory.pieces().end(), goesOn)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace otter_nav::stopping
