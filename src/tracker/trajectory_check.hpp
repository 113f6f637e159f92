// Whether a trajectory from outside can be followed at all. Not the verifier of the room
// feasibility: that one proves a plan (joints to rounding, limits, clearance over a map); the
// tracker has no map, follows what is a little off or too fast as well as it can, and only refuses
// what means nothing or can't be sailed at all.
#pragma once

#include "otter_nav/base/result.hpp"
#include "otter_nav/trajectory/trajectory.hpp"

namespace otter_nav::tracker {

// Errors name the piece: no pieces, a duration that is not positive, a coefficient that is not
// finite, position or velocity that jump at a joint, a speed far beyond the vessel's top speed.
[[nodiscard]] Status checkTrajectory(const trajectory::Trajectory& trajectory,
                                     double top_speed_mps);

}  // namespace otter_nav::tracker
