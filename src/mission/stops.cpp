#include "stops.hpp"

#include <algorithm>

#include "otter_nav/stopping/splice.hpp"

namespace otter_nav::mission {

stopping::Braking Stops::from(const Moment& m, const Path& path, double at_s,
                              const stopping::StopLimits& limits) const {
  return stopping::brakingTrajectory(path.trajectory, at_s,
                                     m.obstacles.inKnownWater().startingAt(path.start_time_s),
                                     vessel_, limits);
}

stopping::Braking Stops::now(const Moment& m, const Path& path,
                             const feasibility::SafetyLimits& planned,
                             const stopping::Off& off) const {
  const double at = path.elapsed(m.now_s);
  stopping::StopLimits limits = safety_.stop(planned);
  limits.off = off;
  stopping::Braking found = from(m, path, at, limits);
  if (!found.clear) {
    limits = safety_.leastStop(planned);
    limits.off = off;
    found = from(m, path, at, limits);
  }
  return found;
}

bool Stops::existForAWhile(const Moment& m, const Path& path,
                           const feasibility::SafetyLimits& planned) const {
  constexpr double kStepS = 0.25;
  constexpr int kSteps = 5;
  const stopping::StopLimits limits = safety_.stop(planned);
  for (int k = 1; k <= kSteps; ++k) {
    const double at = path.elapsed(m.now_s) + k * kStepS;
    if (at < path.trajectory.duration() && !from(m, path, at, limits).clear) {
      return false;
    }
  }
  return true;
}

bool Stops::endNarrowerThanKept(const Moment& m, const Path& path,
                                const feasibility::SafetyLimits& planned, double until_s) const {
  constexpr double kStepS = 1.0;
  const feasibility::Obstacles known = m.obstacles.inKnownWater();
  const auto room = [&](const trajectory::Trajectory& stop, double start_s) {
    return std::min(stopping::kSwingsM,
                    stopping::roomAtRest(stop, known.startingAt(start_s), vessel_));
  };
  const double kept_m = room(kept_->trajectory, kept_->start_time_s);
  for (double later = path.elapsed(m.now_s) + kStepS; later < until_s; later += kStepS) {
    const stopping::Braking braking = from(m, path, later, safety_.stop(planned));
    if (braking.clear && room(braking.trajectory, path.start_time_s + later) >= kept_m) {
      return false;
    }
  }
  return true;
}

bool Stops::find(const Moment& m, const Path& path, const feasibility::SafetyLimits& planned,
                 const stopping::Off& off) {
  constexpr double kReserveS = 0.25;
  constexpr double kLaterS[] = {0.5, 1.0, 2.0, 3.5, 5.0};
  stopping::StopLimits limits = safety_.stop(planned);
  limits.off = off;
  if (keepLater(m, path, kReserveS, limits)) {
    return true;
  }
  if (!isClear(m, path, limits)) {
    return false;
  }
  for (const double later_s : kLaterS) {
    if (keepLater(m, path, kReserveS + later_s, limits)) {
      return true;
    }
  }
  // One with less beside it than the plan has is better than an old one, and that than none.
  limits = safety_.leastStop(planned);
  limits.off = off;
  return keepLater(m, path, kReserveS, limits) || kept_;
}

bool Stops::keepLater(const Moment& m, const Path& path, double later_s,
                      const stopping::StopLimits& limits) {
  const double at = path.elapsed(m.now_s) + later_s;
  if (at >= path.trajectory.duration()) {
    kept_ = path;
    return true;
  }
  stopping::Braking found = from(m, path, at, limits);
  if (found.clear) {
    kept_ = stopping::splice(path, m.now_s, {std::move(found.trajectory), path.start_time_s + at});
  }
  return found.clear;
}

bool Stops::isClear(const Moment& m, const Path& path, const stopping::StopLimits& limits) const {
  constexpr double kHorizonS = 8.0;
  const double at = path.elapsed(m.now_s);
  const feasibility::Obstacles known = m.obstacles.inKnownWater().startingAt(path.start_time_s);
  return !stopping::outlineConflict(path.trajectory, at, at + kHorizonS, known, vessel_,
                                    std::max(safety_.critical(), limits.hull_margin_m), true,
                                    limits.disturbance)
              .found &&
         stopping::firstTouch(path.trajectory, at, known, vessel_, limits.off).after_s > kHorizonS;
}

}  // namespace otter_nav::mission
