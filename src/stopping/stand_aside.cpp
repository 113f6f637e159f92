#include "otter_nav/stopping/stand_aside.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/stopping/back_off.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "otter_nav/trajectory/straight_leg.hpp"
#include "stopping/can_follow.hpp"

namespace otter_nav::stopping {
namespace {

using trajectory::Piece;
using trajectory::Trajectory;

constexpr double kAheadS = 8.0;  // how far ahead is looked at least
constexpr double kStaysS = 4.0;  // and after the vessel has come to rest
constexpr double kAsideStepS = 0.2;
constexpr double kAsideClearM = 0.3;  // of the outline, off what lies still

// The least room on the way and at its end, until the others have passed.
double leastRoom(const Piece& piece, const feasibility::Obstacles& obstacles) {
  const double until = std::max(kAheadS, piece.duration_s + kStaysS);
  double least = obstacles.clearance(piece.flat(0.0).position, 0.0);
  for (double t = kAsideStepS; t <= until; t += kAsideStepS) {
    const Eigen::Vector2d there = piece.flat(std::min(t, piece.duration_s)).position;
    least = std::min(least, obstacles.clearance(there, t));
  }
  return least;
}

// The quickest that the thrusters give, of a few.
std::optional<Piece> quickest(const vessel::State& state, double ahead_m,
                              const feasibility::Obstacles& still,
                              const vessel::Parameters& vessel) {
  constexpr double kLongest = 3.0;
  constexpr double kLonger = 1.3;
  // Half of the way the weaker thrust astern speeds the hull up, half of it it slows her down.
  const double accel_mps2 =
      2.0 * vessel.thrusters.astern_max_n / vessel.manoeuvring.surge_inertia_kg;
  const double least_s = 2.0 * std::sqrt(std::abs(ahead_m) / accel_mps2);
  for (double longer = kLonger; longer <= kLongest; longer *= kLonger) {
    const Piece piece =
        trajectory::straightLeg(state.head<2>(), state[vessel::kPsi], ahead_m, longer * least_s);
    const Trajectory path({piece});
    if (canFollow(path, still, vessel)) {
      return outlineConflict(path, 0.0, path.duration(), still, vessel, kAsideClearM, true).found
                 ? std::nullopt
                 : std::optional(piece);
    }
  }
  return std::nullopt;
}

}  // namespace

bool isRunDown(const Eigen::Vector2d& position, const feasibility::Obstacles& obstacles,
               const vessel::Hull& hull) {
  constexpr double kNearerM = 0.5;  // than now: what lies still comes no nearer
  const double room = turningRoom(hull);
  const double now = obstacles.clearance(position, 0.0);
  for (double t = kAsideStepS; t <= kAheadS; t += kAsideStepS) {
    const double there = obstacles.clearance(position, t);
    if (there < room && there < now - kNearerM) {
      return true;
    }
  }
  return false;
}

std::optional<Trajectory> standAside(const vessel::State& state,
                                     const feasibility::Obstacles& obstacles,
                                     const vessel::Parameters& vessel) {
  constexpr double kWorthM = 0.5;
  const feasibility::Obstacles still(obstacles.field());
  double most =
      kWorthM +
      leastRoom(trajectory::straightLeg(state.head<2>(), state[vessel::kPsi], 0.0, 1.0), obstacles);
  std::optional<Trajectory> best;
  for (const double side : {1.0, -1.0}) {
    for (const double lengths : {1.0, 2.0, 3.0, 4.0, 6.0}) {
      const std::optional<Piece> piece =
          quickest(state, side * lengths * vessel.hull.length_m, still, vessel);
      if (!piece) {
        break;  // nor does it lead farther
      }
      const double room = leastRoom(*piece, obstacles);
      if (room > most) {
        most = room;
        best = Trajectory({*piece});
      }
    }
  }
  return best;
}

}  // namespace otter_nav::stopping
