// Ways to rest from what is sailed, in water known to be free, and the one that is kept: at every
// decision one that begins a little later is verified, so that there always is one
// (docs/mission.md).
#pragma once

#include <optional>
#include <utility>

#include "moment.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/stopping/braking.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "safety.hpp"

namespace otter_nav::mission {

// `planned`: what the trajectory that is sailed was planned to keep.
class Stops {
 public:
  using Path = trajectory::TimedTrajectory;

  Stops(const Safety& safety, const vessel::Parameters& vessel)
      : safety_(safety), vessel_(vessel) {}

  // From `at_s` on the path's clock; what nobody saw to be free stops there.
  [[nodiscard]] stopping::Braking from(const Moment& m, const Path& path, double at_s,
                                       const stopping::StopLimits& limits) const;
  // From now on, off the path by that; with the plan's own margin if that can be had.
  [[nodiscard]] stopping::Braking now(const Moment& m, const Path& path,
                                      const feasibility::SafetyLimits& planned,
                                      const stopping::Off& off) const;
  // Whether one can begin at any time soon. A way to rest is given up for nothing less: going on
  // and stopping in turns, the hull is soon off all of them.
  [[nodiscard]] bool existForAWhile(const Moment& m, const Path& path,
                                    const feasibility::SafetyLimits& planned) const;
  // None that begins before `until_s` on the path's clock ends with as much beside the hull as the
  // one that is kept.
  [[nodiscard]] bool endNarrowerThanKept(const Moment& m, const Path& path,
                                         const feasibility::SafetyLimits& planned,
                                         double until_s) const;

  // One that begins a little later than now: when the next decision is due, there is time to take
  // it. A launch, or sailing crabwise, may leave none that keeps to the thrusters' limits at the
  // moment: then one that begins later, where the way until then is clear in known water. Kept if
  // there is one.
  bool find(const Moment& m, const Path& path, const feasibility::SafetyLimits& planned,
            const stopping::Off& off);
  // As it was found last, from what was sailed then.
  [[nodiscard]] const std::optional<Path>& kept() const { return kept_; }
  void keep(std::optional<Path> stop) { kept_ = std::move(stop); }
  void forget() { kept_.reset(); }

 private:
  // One that begins so much later; the way's own end is one.
  bool keepLater(const Moment& m, const Path& path, double later_s,
                 const stopping::StopLimits& limits);
  // For long enough to rest later.
  [[nodiscard]] bool isClear(const Moment& m, const Path& path,
                             const stopping::StopLimits& limits) const;

  const Safety& safety_;
  const vessel::Parameters& vessel_;
  std::optional<Path> kept_;
};

}  // namespace otter_nav::mission
