#include "way_ahead.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/vessel/hull.hpp"
#include "sea_room.hpp"

namespace otter_nav::mission {

using feasibility::Obstacles;
using stopping::Conflict;
using trajectory::TimedTrajectory;

Conflict WayAhead::narrow() const {
  constexpr double kSlackM = 0.3;
  const TimedTrajectory& path = sailed_.path;
  const Conflict centre =
      stopping::firstConflict(path.trajectory, path.elapsed(moment_.now_s),
                              sailed_.obstacles(moment_), sailed_.plan.clearance_m - kSlackM);
  const double until = centre.found ? centre.time_s : path.trajectory.duration();
  const Conflict hull = ofHull(until, safety_.critical());
  return hull.found ? hull : centre;
}

Conflict WayAhead::tooNear() const {
  return ofHull(sailed_.path.trajectory.duration(), safety_.critical());
}

bool WayAhead::isAboutToTouch() const {
  constexpr double kForeseesS = 4.0;
  const double now_s = moment_.now_s;
  if (sailed_.isAtTheEnd(now_s)) {
    return false;
  }
  const vessel::State& x = moment_.situation.state;
  const vessel::Foreseen& foreseen = moment_.situation.foreseen;
  return stopping::isAboutToTouch(sailed_.path.trajectory, sailed_.path.elapsed(now_s), x,
                                  sailed_.obstacles(moment_), vessel_,
                                  sailed_.plan.limits.disturbance) ||
         (foreseen.start_s >= sailed_.given_s &&
          stopping::isAboutToTouch(foreseen, now_s, now_s + kForeseesS, x,
                                   Obstacles(moment_.obstacles.field()), vessel_.hull));
}

bool WayAhead::hasRoomFor(const feasibility::SafetyLimits& asked, double clearance_m) const {
  constexpr double kAheadS = 30.0;
  constexpr double kStepM = 0.5;  // that room to leeward is measured in
  const TimedTrajectory& path = sailed_.path;
  const double speed_mps = sailed_.plan.limits.speed_max_mps;
  return safety_.paceAt(safety_.level(), speed_mps) >= speed_mps &&
         !stopping::firstConflict(path.trajectory, path.elapsed(moment_.now_s),
                                  sailed_.obstacles(moment_), clearance_m)
              .found &&
         !ofHull(path.trajectory.duration(), std::max(safety_.critical(), asked.hull_margin_m))
              .found &&
         SeaRoom(moment_, safety_, vessel_.hull).toLeeward(path, kAheadS) >=
             asked.drift_m.norm() - kStepM;
}

bool WayAhead::hasRoomToJoin(const TimedTrajectory& path,
                             const feasibility::SafetyLimits& planned) const {
  constexpr double kUntilMadeGoodS = 5.0;
  const stopping::Off off = sailed_.off(moment_, vessel_);
  const double off_m =
      off.position_m.norm() + vessel::circumscribedRadius(vessel_.hull) * std::abs(off.heading_rad);
  const double at = path.elapsed(moment_.now_s);
  return !stopping::outlineConflict(path.trajectory, at, at + kUntilMadeGoodS,
                                    Obstacles(moment_.obstacles.field()), vessel_, off_m, true,
                                    planned.disturbance)
              .found;
}

bool WayAhead::leavesRoomOn(const TimedTrajectory& path, double share, double ahead_s) const {
  const double from = path.elapsed(moment_.now_s);
  const double to = std::min(path.trajectory.duration(), from + ahead_s);
  return !stopping::outlineConflict(path.trajectory, from, to,
                                    moment_.obstacles.startingAt(path.start_time_s), vessel_,
                                    share * safety_.reach(), true, safety_.weather().mean())
              .found;
}

double WayAhead::leastRoom(const TimedTrajectory& path, double from_s) const {
  return stopping::leastClearance(path.trajectory, path.elapsed(from_s),
                                  Obstacles(moment_.obstacles.field()));
}

bool WayAhead::keepsBeside(const TimedTrajectory& path, double from_s, double ahead_s,
                           double beside_m) const {
  const double from = path.elapsed(from_s);
  const double to = std::min(path.trajectory.duration(), from + ahead_s);
  return !stopping::outlineConflict(path.trajectory, from, to, Obstacles(moment_.obstacles.field()),
                                    vessel_, beside_m, true, safety_.weather().mean())
              .found;
}

double WayAhead::leastBeside(const TimedTrajectory& path, double from_s, double ahead_s,
                             double most_m) const {
  constexpr double kStepM = 0.05;
  double beside_m = most_m;
  while (beside_m > 0.5 * kStepM && !keepsBeside(path, from_s, ahead_s, beside_m)) {
    beside_m -= kStepM;
  }
  return std::max(0.0, beside_m);
}

Conflict WayAhead::ofHull(double until_s, double margin_m) const {
  return stopping::outlineConflict(sailed_.path.trajectory, sailed_.path.elapsed(moment_.now_s),
                                   until_s, sailed_.obstacles(moment_), vessel_, margin_m, true,
                                   sailed_.plan.limits.disturbance);
}

}  // namespace otter_nav::mission
