#include "otter_nav/stopping/braking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/stopping/splice.hpp"
#include "otter_nav/vessel/thrusters.hpp"
#include "straight_stop.hpp"

namespace otter_nav::stopping {
namespace {

using trajectory::Piece;
using trajectory::PieceKind;
using trajectory::Trajectory;
using vessel::FlatPoint;

constexpr double kUnderWayMps = 0.3;
constexpr double kKnotS = 0.25;
// The sailed trajectory may be at the thrusters' limits where the stop begins; the tracker shaves
// off a short peak.
constexpr double kLeastForceShare = 0.01;  // |w| while turning, of both thrusters ahead
constexpr double kThrustTolerance = 1.1;

// Along the way with its time slowed down smoothly to nothing within `duration_s`: z(s(t)) with
// s' = 1 - (10 x^3 - 15 x^4 + 6 x^5), x = t / duration. Half the duration of way is used up.
FlatPoint slowedPoint(const Trajectory& sailed, double at_s, double t, double duration_s) {
  const double x = t / duration_s;
  const double x2 = x * x;
  const double x3 = x2 * x;
  const double s = at_s + duration_s * (x - x2 * x2 * (2.5 - 3.0 * x + x2));
  const double rate = 1.0 - x3 * (10.0 - 15.0 * x + 6.0 * x2);
  const double rate1 = -30.0 * x2 * (1.0 - 2.0 * x + x2) / duration_s;
  const double rate2 = -60.0 * x * (1.0 - 3.0 * x + 2.0 * x2) / (duration_s * duration_s);
  const FlatPoint z = sailed.flat(s);
  FlatPoint slowed;
  slowed.position = z.position;
  slowed.velocity = z.velocity * rate;
  slowed.acceleration = z.acceleration * (rate * rate) + z.velocity * rate1;
  slowed.jerk =
      z.jerk * (rate * rate * rate) + z.acceleration * (3.0 * rate * rate1) + z.velocity * rate2;
  return slowed;
}

Trajectory slowed(const Trajectory& sailed, double at_s, double duration_s) {
  const int knots = std::max(4, static_cast<int>(std::ceil(duration_s / kKnotS)));
  const double step = duration_s / knots;
  std::vector<Piece> pieces;
  FlatPoint previous = slowedPoint(sailed, at_s, 0.0, duration_s);
  for (int k = 1; k <= knots; ++k) {
    const FlatPoint next = slowedPoint(sailed, at_s, k * step, duration_s);
    pieces.push_back(trajectory::hermitePiece(previous, next, step));
    previous = next;
  }
  return Trajectory(std::move(pieces));
}

double leastClearance(const Trajectory& trajectory, const feasibility::Obstacles& obstacles) {
  constexpr double kStepS = 0.05;
  double least = std::numeric_limits<double>::infinity();
  const int steps = static_cast<int>(std::ceil(trajectory.duration() / kStepS));
  for (int k = 0; k <= steps; ++k) {
    const double t = k * kStepS;
    least = std::min(least, obstacles.clearance(trajectory.flat(t).position, t));
  }
  return least;
}

// Astern, a planned stop leaves part of the thrust to the tracker.
bool keepsAsternShare(const Trajectory& trajectory, const vessel::Parameters& vessel) {
  constexpr double kShare = 0.9;
  constexpr double kStepS = 0.05;
  const int steps = static_cast<int>(std::ceil(trajectory.duration() / kStepS));
  for (int k = 0; k <= steps; ++k) {
    const double least = trajectory.sample(k * kStepS, vessel).thrusts.minCoeff();
    if (least < -kShare * vessel.thrusters.astern_max_n) {
      return false;
    }
  }
  return true;
}

bool endsAtRest(const Piece& piece) {
  constexpr double kRest = 1e-3;  // m/s and rad/s
  const double end = piece.duration_s;
  return piece.flat(end).velocity.norm() < kRest &&
         (piece.kind != PieceKind::kSpin || std::abs(piece.spinHeading(end)[1]) < kRest);
}

// Where a sailed trajectory comes to rest by itself soon.
std::optional<Trajectory> ownRest(const Trajectory& sailed, double at_s, double within_s) {
  std::vector<Piece> pieces = remainder(sailed, at_s).pieces();
  double duration = 0.0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    duration += pieces[k].duration_s;
    if (duration > within_s) {
      return std::nullopt;
    }
    if (endsAtRest(pieces[k])) {
      pieces.resize(k + 1);
      return Trajectory(std::move(pieces));
    }
  }
  return std::nullopt;
}

// A turn on the spot brought to an end.
Trajectory stopTurning(const Piece& spin, double t_s) {
  constexpr double kTurnsOnS = 0.8;
  const Eigen::Vector3d psi = spin.spinHeading(t_s);
  FlatPoint from;
  from.position.x() = psi[0];
  from.velocity.x() = psi[1];
  from.acceleration.x() = psi[2];
  FlatPoint to;
  to.position.x() = psi[0] + 0.5 * kTurnsOnS * psi[1];
  Piece stop;
  stop.kind = PieceKind::kSpin;
  stop.duration_s = kTurnsOnS;
  stop.position.col(0) = spin.flat(t_s).position;
  stop.heading = trajectory::hermitePiece(from, to, kTurnsOnS).position.row(0);
  return Trajectory({stop});
}

// From gentle to hard, by the way they need.
std::vector<Trajectory> candidates(const Trajectory& sailed, double at_s) {
  constexpr std::array<double, 5> kSlowS = {12.0, 9.0, 7.0, 5.5, 4.0};
  constexpr std::array<StraightStop, 16> kStraight = {{{3.0, 4.5},
                                                       {2.0, 4.5},
                                                       {2.0, 3.2},
                                                       {2.0, 2.4},
                                                       {1.3, 3.2},
                                                       {1.3, 2.4},
                                                       {0.9, 3.2},
                                                       {0.6, 3.2},
                                                       {0.9, 2.4},
                                                       {0.9, 2.0},
                                                       {0.3, 3.2},
                                                       {0.6, 2.4},
                                                       {0.6, 2.0},
                                                       {0.3, 2.4},
                                                       {0.3, 2.0},
                                                       {0.3, 1.6}}};
  std::vector<Trajectory> all;
  if (std::optional<Trajectory> rest = ownRest(sailed, at_s, kSlowS.front())) {
    all.push_back(std::move(*rest));
  }
  const FlatPoint from = sailed.flat(at_s);
  const std::size_t now = sailed.pieceAt(at_s);
  if (sailed.pieces()[now].kind == PieceKind::kSpin && from.velocity.norm() < kUnderWayMps) {
    if (all.empty()) {
      all.push_back(stopTurning(sailed.pieces()[now], at_s - sailed.startOf(now)));
    }
    return all;
  }
  for (const double duration : kSlowS) {
    if (!ownRest(sailed, at_s, 0.5 * duration)) {
      all.push_back(slowed(sailed, at_s, duration));
    }
  }
  if (from.velocity.norm() > kUnderWayMps) {
    for (const StraightStop& stop : kStraight) {
      all.push_back(straightStop(from, stop));
    }
  }
  return all;
}

}  // namespace

Braking brakingTrajectory(const Trajectory& sailed, double at_s,
                          const feasibility::Obstacles& obstacles, const vessel::Parameters& vessel,
                          double clearance_m) {
  feasibility::SafetyLimits limits = feasibility::SafetyLimits::of(vessel, clearance_m);
  limits.thrust_share = kThrustTolerance;
  limits.speed_max_mps = 2.0 * vessel.top_speed_mps;
  feasibility::Tolerances tolerances;
  tolerances.heading_force_share = kLeastForceShare;
  tolerances.step_s = 0.02;
  const feasibility::Obstacles ahead = obstacles.startingAt(at_s);
  Braking best;
  best.clearance_m = -1.0;
  for (Trajectory& candidate : candidates(sailed, at_s)) {
    if (candidate.empty()) {
      continue;
    }
    if (keepsAsternShare(candidate, vessel) &&
        feasibility::verify(candidate, ahead, vessel, limits, tolerances).ok) {
      return {std::move(candidate), true, clearance_m};
    }
    const double clearance = leastClearance(candidate, ahead);
    if (clearance >= best.clearance_m) {  // of equals the harder stop
      best = {std::move(candidate), false, clearance};
    }
  }
  return best;
}

}  // namespace otter_nav::stopping
