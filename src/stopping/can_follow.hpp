#pragma once

#include "otter_nav/feasibility/verifier.hpp"

namespace otter_nav::stopping {

// With all the thrust there is; the hull's outline is seen to elsewhere.
[[nodiscard]] inline bool canFollow(const trajectory::Trajectory& path,
                                    const feasibility::Obstacles& obstacles,
                                    const vessel::Parameters& vessel) {
  feasibility::SafetyLimits limits = feasibility::SafetyLimits::of(vessel, -1.0);
  limits.thrust_share = 1.0;
  feasibility::Tolerances tolerances;
  tolerances.keep_hull_clear = false;
  return feasibility::verify(path, obstacles, vessel, limits, tolerances).ok;
}

}  // namespace otter_nav::stopping
