#include "otter_nav/stopping/back_off.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::stopping {
namespace {

using feasibility::Obstacles;
using trajectory::Piece;
using trajectory::Trajectory;

constexpr double kClearM = 0.1;     // of the outline, when it sets off
constexpr double kTightM = 0.04;    // where there is no more than this to begin with
constexpr double kTouchesM = 0.02;  // on the way: half of that

// Straight along the heading, with a mean speed of a walk and time to gather way: gentle, for the
// water there is the less known.
Piece straight(const Eigen::Vector2d& start, double psi_rad, double ahead_m) {
  constexpr double kSpeedMps = 0.6;
  constexpr double kGatherS = 2.0;
  vessel::FlatPoint from;
  from.position = start;
  vessel::FlatPoint to;
  to.position = start + ahead_m * Eigen::Vector2d(std::cos(psi_rad), std::sin(psi_rad));
  Piece piece = trajectory::hermitePiece(from, to, kGatherS + std::abs(ahead_m) / kSpeedMps);
  piece.kind = trajectory::PieceKind::kSpin;  // the heading is its own: astern it can't follow
  piece.heading.setZero();
  piece.heading[0] = psi_rad;
  return piece;
}

Piece gentleSpin(const Eigen::Vector2d& position, double psi_rad, double turn_rad) {
  constexpr double kRateRadps = 0.3;
  constexpr double kGatherS = 2.0;
  return trajectory::spinPiece(position, psi_rad, psi_rad + turn_rad,
                               kGatherS + std::abs(turn_rad) / kRateRadps);
}

bool outlineKeepsClear(const Trajectory& path, double from_s, const vessel::Parameters& vessel,
                       const Obstacles& obstacles, double least_m, bool edge) {
  return !outlineConflict(path, from_s, path.duration(), obstacles, vessel, least_m, edge).found;
}

bool canFollow(const Trajectory& path, const Obstacles& obstacles,
               const vessel::Parameters& vessel) {
  feasibility::SafetyLimits limits = feasibility::SafetyLimits::of(vessel, -1.0);
  limits.thrust_share = 1.0;
  feasibility::Tolerances tolerances;
  tolerances.keep_hull_clear = false;  // seen to by the outline
  return feasibility::verify(path, obstacles, vessel, limits, tolerances).ok;
}

// Places inside the map's edge with room to turn, the nearest first.
std::vector<Eigen::Vector2d> placesInside(const Eigen::Vector2d& position,
                                          const Obstacles& obstacles, const vessel::Hull& hull) {
  constexpr int kLengths = 4;  // to all sides of the nearest
  const double room = turningRoom(hull);
  const map::GridGeometry& map = obstacles.field().geometry();
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(room + map.resolution_m);
  const Eigen::Vector2d low = map.origin + margin;
  const Eigen::Vector2d high =
      map.origin + map.resolution_m * Eigen::Vector2d(map.width, map.height) - margin;
  const Eigen::Vector2d nearest = position.cwiseMax(low).cwiseMin(high);
  std::vector<Eigen::Vector2d> places;
  for (int i = -kLengths; i <= kLengths; ++i) {
    for (int j = -kLengths; j <= kLengths; ++j) {
      const Eigen::Vector2d place = nearest + hull.length_m * Eigen::Vector2d(i, j);
      if (obstacles.clearance(place, 0.0) >= room) {
        places.push_back(place);
      }
    }
  }
  std::sort(places.begin(), places.end(), [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a - position).squaredNorm() < (b - position).squaredNorm();
  });
  return places;
}

}  // namespace

double insideMap(const map::GridGeometry& map, const Eigen::Vector2d& p) {
  const Eigen::Vector2d low = p - map.origin;
  const Eigen::Vector2d high = map.resolution_m * Eigen::Vector2d(map.width, map.height) - low;
  return std::min(low.minCoeff(), high.minCoeff());
}

double turningRoom(const vessel::Hull& hull) {
  constexpr double kMarginM = 0.3;
  return 0.5 * std::hypot(hull.length_m, hull.beam_m) + kMarginM;
}

std::optional<Trajectory> backOff(const vessel::State& state, const Obstacles& obstacles,
                                  const vessel::Parameters& vessel, double disturbance_n) {
  constexpr double kBetterM = 0.1;  // than here, or it isn't worth the way
  constexpr std::array<double, 7> kTurnsRad = {0.0, 0.3, -0.3, 0.6, -0.6, 1.0, -1.0};
  const double drift_mps = disturbance_n / vessel.manoeuvring.sway_drag_kgps;
  const double room = turningRoom(vessel.hull);
  const Eigen::Vector2d here = state.head<2>();
  const double psi = state[vessel::kPsi];
  const auto near = [&](const Eigen::Vector2d& p) { return obstacles.clearance(p, 0.0); };
  const double keep_m = std::clamp(
      feasibility::outlineClearance(vessel.hull, here, psi, near) - kTouchesM, kTightM, kClearM);
  double best_m = obstacles.clearance(here, 0.0) + kBetterM;
  std::optional<Trajectory> best;
  for (const double turn : kTurnsRad) {
    for (const double side : {-1.0, 1.0}) {
      for (const double lengths : {0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0}) {
        const double ahead = side * lengths * vessel.hull.length_m;
        std::vector<Piece> pieces;
        if (turn != 0.0) {
          pieces.push_back(gentleSpin(here, psi, turn));
        }
        pieces.push_back(straight(here, psi + turn, ahead));
        Trajectory path(std::move(pieces));
        const double end = path.duration();
        const double there_m = std::min(room, obstacles.clearance(path.flat(end).position, end));
        if (there_m <= best_m) {
          continue;
        }
        if (!outlineKeepsClear(path, 0.0, vessel, obstacles, keep_m + drift_mps * end, true)) {
          break;  // nor does it further on
        }
        if (canFollow(path, obstacles, vessel)) {
          best_m = there_m;
          best = std::move(path);
        }
      }
    }
    if (best_m >= room) {
      break;
    }
  }
  return best;
}

std::optional<Trajectory> turnBack(const vessel::State& state, const Obstacles& obstacles,
                                   const vessel::Parameters& vessel) {
  constexpr double kAlignedRad = 0.01;
  const Eigen::Vector2d position = state.head<2>();
  const double psi = state[vessel::kPsi];
  for (const Eigen::Vector2d& place : placesInside(position, obstacles, vessel.hull)) {
    const Eigen::Vector2d there = place - position;
    const double bearing = wrapAngle(std::atan2(there.y(), there.x()) - psi);
    const bool astern = std::abs(bearing) > 0.5 * kPi;
    const double turn = astern ? wrapAngle(bearing + kPi) : bearing;
    std::vector<Piece> pieces;
    if (std::abs(turn) > kAlignedRad) {
      pieces.push_back(gentleSpin(position, psi, turn));
    }
    pieces.push_back(straight(position, psi + (pieces.empty() ? 0.0 : turn),
                              astern ? -there.norm() : there.norm()));
    Trajectory path(std::move(pieces));
    if (outlineKeepsClear(path, 0.0, vessel, obstacles, kClearM, false) &&
        canFollow(path, obstacles, vessel)) {
      return path;
    }
  }
  return std::nullopt;
}

bool backOffIsClear(const Trajectory& path, double from_s, const Obstacles& obstacles,
                    const vessel::Parameters& vessel) {
  return outlineKeepsClear(path, from_s, vessel, obstacles, kTouchesM, true);
}

bool turnBackIsClear(const Trajectory& path, double from_s, const Obstacles& obstacles,
                     const vessel::Parameters& vessel) {
  return outlineKeepsClear(path, from_s, vessel, obstacles, kTouchesM, false);
}

}  // namespace otter_nav::stopping
