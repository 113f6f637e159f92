#include "otter_nav/stopping/watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/parts.hpp"
#include "otter_nav/feasibility/clearance_walk.hpp"
#include "otter_nav/stopping/back_off.hpp"
#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::stopping {
namespace {

using feasibility::Obstacles;
using trajectory::Piece;
using trajectory::Trajectory;

// What stands near a point of the outline; without `edge` only what is nearer than the map's edge
// counts.
double pointClearance(const Eigen::Vector2d& p, double time_s, const Obstacles& obstacles,
                      bool edge) {
  const double clearance = obstacles.clearance(p, time_s);
  if (edge) {
    return clearance;
  }
  constexpr double kTightCells = 0.15;  // of the field's bound
  const map::GridGeometry& map = obstacles.field().geometry();
  const bool edge_is_nearest = clearance >= insideMap(map, p) - kTightCells * map.resolution_m;
  return edge_is_nearest ? std::numeric_limits<double>::infinity() : clearance;
}

double besideHull(const vessel::Pose& pose, double time_s, const Obstacles& obstacles,
                  const vessel::Hull& hull) {
  return feasibility::outlineClearance(
      hull, pose.position, pose.psi_rad,
      [&](const Eigen::Vector2d& p) { return obstacles.clearance(p, time_s); });
}

// With less beside it a hull that lies there now will touch, m. Where it touches by the map
// already, what leads away is no worse.
double touchesFrom(const vessel::Pose& now, double time_s, const Obstacles& obstacles,
                   const vessel::Hull& hull) {
  constexpr double kContactM = 0.01;
  return std::min(kContactM, besideHull(now, time_s, obstacles, hull) - kContactM);
}

// Of a spin by its polynomial; under sail by what the thrusters can hold.
double turningBound(const Piece& piece, const vessel::Parameters& vessel) {
  if (piece.kind == trajectory::PieceKind::kSail) {
    return feasibility::SafetyLimits::of(vessel).yaw_rate_max_radps;
  }
  double turning = 0.0;
  for (int k = 1; k < trajectory::kCoefficients; ++k) {
    turning += k * std::abs(piece.heading[k]) * std::pow(piece.duration_s, k - 1);
  }
  return turning;
}

}  // namespace

Off offTrajectory(const Trajectory& trajectory, double at_s, const vessel::State& state,
                  const vessel::Parameters& vessel, const vessel::Disturbance& disturbance) {
  const vessel::State wanted = trajectory.sample(at_s, vessel, disturbance).state;
  return {state.head<2>() - wanted.head<2>(),
          wrapAngle(state[vessel::kPsi] - wanted[vessel::kPsi])};
}

Conflict firstConflict(const Trajectory& trajectory, double from_s, const Obstacles& obstacles,
                       double clearance_m) {
  if (trajectory.empty()) {
    return {};
  }
  feasibility::SafetyLimits limits;
  limits.clearance_m = clearance_m - feasibility::kLeastSlackM;
  const feasibility::PieceWalk walk(limits, false);
  for (std::size_t i = trajectory.pieceAt(from_s); i < trajectory.pieces().size(); ++i) {
    const Piece& piece = trajectory.pieces()[i];
    const double start = trajectory.startOf(i);
    const double from = std::clamp(from_s - start, 0.0, piece.duration_s);
    const feasibility::Walked walked = walk.along(piece, from, obstacles, start, 0.0,
                                                  [](double) { return Eigen::Vector2d::UnitX(); });
    if (walked.conflict_s) {
      return {true, start + *walked.conflict_s, piece.flat(*walked.conflict_s).position,
              walked.centre_m};
    }
  }
  return {};
}

double leastClearance(const Trajectory& trajectory, double from_s, const Obstacles& obstacles) {
  constexpr double kStepS = 0.05;
  double least = std::numeric_limits<double>::infinity();
  const int steps = partsOf(trajectory.duration() - from_s, kStepS, 0);
  for (int k = 0; k <= steps; ++k) {
    const double t = from_s + k * kStepS;
    least = std::min(least, obstacles.clearance(trajectory.flat(t).position, t));
  }
  return least;
}

Conflict outlineConflict(const Trajectory& trajectory, double from_s, double to_s,
                         const Obstacles& obstacles, const vessel::Parameters& vessel,
                         double clearance_m, bool edge, const vessel::Disturbance& disturbance,
                         const Off& off) {
  constexpr double kMadeGoodS = 3.0;
  if (trajectory.empty()) {
    return {};
  }
  const double reach = vessel::circumscribedRadius(vessel.hull);
  const double made_good_mps =
      (off.position_m.norm() + reach * std::abs(off.heading_rad)) / kMadeGoodS;
  for (std::size_t i = trajectory.pieceAt(from_s);
       i < trajectory.pieces().size() && trajectory.startOf(i) <= to_s; ++i) {
    const Piece& piece = trajectory.pieces()[i];
    const double start = trajectory.startOf(i);
    const double approach =
        trajectory::speedBound(trajectory::differentiate<8>(piece.position), piece.duration_s) +
        reach * turningBound(piece, vessel) + obstacles.rateBound() + made_good_mps;
    double nearest = 0.0;
    const auto slack = [&](double t) {
      const double still =
          std::max(0.0, 1.0 - (start + t - from_s) / kMadeGoodS);  // of what is off
      const Eigen::Vector2d centre =
          trajectory::evaluate<8>(piece.position, t) + still * off.position_m;
      if (edge) {
        nearest = obstacles.clearance(centre, start + t) - reach;
        if (nearest > clearance_m + 0.5 * reach) {
          return nearest - clearance_m;
        }
      }
      const double psi = trajectory.sampleIn(i, t, vessel, disturbance).state[vessel::kPsi] +
                         still * off.heading_rad;
      nearest = feasibility::outlineClearance(
          vessel.hull, centre, psi,
          [&](const Eigen::Vector2d& p) { return pointClearance(p, start + t, obstacles, edge); });
      // No clearance is less than none: where none is to be kept, touching counts.
      const double left =
          nearest - std::max(clearance_m, feasibility::kLeastSlackM) + feasibility::kLeastSlackM;
      // Without the edge the clearance is no bound of what comes next: short steps.
      constexpr double kShortM = 0.05;
      return edge ? left : std::min(left, kShortM);
    };
    const double from = std::clamp(from_s - start, 0.0, piece.duration_s);
    const double to = std::clamp(to_s - start, from, piece.duration_s);
    if (const auto t = feasibility::firstConflict(from, to, approach, slack)) {
      return {true, start + *t, piece.flat(*t).position, nearest};
    }
  }
  return {};
}

bool isAboutToTouch(const Trajectory& trajectory, double at_s, const vessel::State& state,
                    const Obstacles& obstacles, const vessel::Parameters& vessel,
                    const vessel::Disturbance& disturbance) {
  constexpr double kOffRad = 0.1;  // less is what margins are for
  constexpr double kSoonS = 1.5;
  constexpr double kEachS = 0.1;
  const Off off = offTrajectory(trajectory, at_s, state, vessel, disturbance);
  if (std::abs(off.heading_rad) < kOffRad) {
    return false;
  }
  const double touches_m =
      touchesFrom({state.head<2>(), state[vessel::kPsi]}, at_s, obstacles, vessel.hull);
  const double until = std::min(trajectory.duration(), at_s + kSoonS);
  for (double t = at_s + kEachS; t <= until; t += kEachS) {
    const vessel::State there = trajectory.sample(t, vessel, disturbance).state;
    if (besideHull({there.head<2>() + off.position_m, there[vessel::kPsi] + off.heading_rad}, t,
                   obstacles, vessel.hull) < touches_m) {
      return true;
    }
  }
  return false;
}

bool isAboutToTouch(const vessel::Foreseen& foreseen, double from_s, double to_s,
                    const vessel::State& state, const Obstacles& obstacles,
                    const vessel::Hull& hull) {
  const double touches_m =
      touchesFrom({state.head<2>(), state[vessel::kPsi]}, from_s, obstacles, hull);
  for (std::size_t k = 0; k < foreseen.poses.size(); ++k) {
    const double t = foreseen.start_s + static_cast<double>(k) * foreseen.step_s;
    if (t >= from_s && t <= to_s && besideHull(foreseen.poses[k], t, obstacles, hull) < touches_m) {
      return true;
    }
  }
  return false;
}

bool Touch::milderThan(const Touch& other) const {
  constexpr double kMps = 0.2;
  constexpr double kLaterS = 0.3;
  return std::abs(speed_mps - other.speed_mps) > kMps ? speed_mps < other.speed_mps
                                                      : after_s > other.after_s + kLaterS;
}

Touch firstTouch(const Trajectory& trajectory, double from_s, const Obstacles& obstacles,
                 const vessel::Parameters& vessel, const Off& off) {
  constexpr double kRestsS = 8.0;
  if (trajectory.empty()) {
    return {};
  }
  const double end = trajectory.duration();
  const auto touchUnderWay = [&](const Off& o) {
    const Conflict c =
        outlineConflict(trajectory, from_s, end, obstacles, vessel, 0.0, true, {}, o);
    return c.found ? Touch{c.time_s - from_s, trajectory.flat(c.time_s).velocity.norm()} : Touch{};
  };
  const Touch planned = touchUnderWay({});
  const bool lies_off = off.position_m.norm() > 0.0 || off.heading_rad != 0.0;
  const Touch as_it_lies = lies_off ? touchUnderWay(off) : Touch{};
  const bool counts = as_it_lies.after_s > 0.0 && planned.milderThan(as_it_lies);
  const Touch& worse = counts ? as_it_lies : planned;
  if (std::isfinite(worse.after_s)) {
    return worse;
  }
  if (obstacles.rateBound() == 0.0) {
    return {};
  }
  const vessel::State last = trajectory.sample(end, vessel).state;
  const Trajectory rest(
      {trajectory::spinPiece(last.head<2>(), last[vessel::kPsi], last[vessel::kPsi], kRestsS)});
  const double later = std::max(end, from_s);
  const Conflict at_rest =
      outlineConflict(rest, 0.0, kRestsS, obstacles.startingAt(later), vessel, 0.0);
  return at_rest.found ? Touch{later - from_s + at_rest.time_s, 0.0} : Touch{};
}

}  // namespace otter_nav::stopping
