// What lies on the way ahead, by the map of the moment, and whether it leaves the room that was
// asked for.
#pragma once

#include "moment.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "safety.hpp"
#include "sailed.hpp"

namespace otter_nav::mission {

// Of one moment; what it is made of outlives it.
class WayAhead {
 public:
  WayAhead(const Moment& moment, const Safety& safety, const vessel::Parameters& vessel,
           const Sailed& sailed)
      : moment_(moment), safety_(safety), vessel_(vessel), sailed_(sailed) {}

  // The first place with less than what the plan was made with, or where the hull's outline comes
  // too near. Sensed outlines wander by about a cell: less than that is no ground for another plan.
  [[nodiscard]] stopping::Conflict narrow() const;
  // The first at which the hull does not pass.
  [[nodiscard]] stopping::Conflict tooNear() const;
  // The hull as it truly lies, and not as it was planned; or what lies still, on the way that the
  // tracker foresees, which knows what drives it.
  [[nodiscard]] bool isAboutToTouch() const;

  // It keeps `clearance_m`, the margin round the hull and the room to leeward that are asked for,
  // at a speed for them: such a plan would have no more.
  [[nodiscard]] bool hasRoomFor(const feasibility::SafetyLimits& asked, double clearance_m) const;
  // What the hull is off its way to rest it is off another path at first, and more while it makes
  // that good in a bend: whether what lies still leaves as much beside that.
  [[nodiscard]] bool hasRoomToJoin(const trajectory::TimedTrajectory& path,
                                   const feasibility::SafetyLimits& planned) const;
  // For that share of how far the vessel wanders by now, on the stretch of a path until then.
  [[nodiscard]] bool leavesRoomOn(const trajectory::TimedTrajectory& path, double share,
                                  double ahead_s) const;

  // Of the hull's centre beside what lies still, m, on a path from then on.
  [[nodiscard]] double leastRoom(const trajectory::TimedTrajectory& path, double from_s) const;
  // Whether a path keeps so much beside the hull's outline, off what lies still, for so long.
  [[nodiscard]] bool keepsBeside(const trajectory::TimedTrajectory& path, double from_s,
                                 double ahead_s, double beside_m) const;
  // How much it keeps, in steps of 0.05 m up to `most_m`.
  [[nodiscard]] double leastBeside(const trajectory::TimedTrajectory& path, double from_s,
                                   double ahead_s, double most_m) const;

 private:
  [[nodiscard]] stopping::Conflict ofHull(double until_s, double margin_m) const;

  const Moment& moment_;
  const Safety& safety_;
  const vessel::Parameters& vessel_;
  const Sailed& sailed_;
};

}  // namespace otter_nav::mission
