// What is left of a sailed trajectory, and how the next one continues it.
#pragma once

#include "otter_nav/trajectory/timed_trajectory.hpp"

namespace otter_nav::stopping {

// The sailed trajectory from its piece at `now_s` on up to `next`'s start, then `next`.
[[nodiscard]] trajectory::TimedTrajectory splice(const trajectory::TimedTrajectory& sailed,
                                                 double now_s,
                                                 const trajectory::TimedTrajectory& next);

// What is left of a trajectory from `at_s` on, exactly.
[[nodiscard]] trajectory::Trajectory remainder(const trajectory::Trajectory& trajectory,
                                               double at_s);

// Whether it comes to rest between its start and its end: to turn on the spot at a corner.
[[nodiscard]] bool restsBeforeItsEnd(const trajectory::Trajectory& trajectory);

}  // namespace otter_nav::stopping
