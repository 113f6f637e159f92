#pragma once

#include "otter_nav/base/result.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::mission {

// Why a goal can't be reached by any plan: not finite, outside the map, with less than
// `clearance_m` around it.
[[nodiscard]] Status checkGoal(const vessel::Pose& goal, const feasibility::Obstacles& obstacles,
                               double clearance_m);

}  // namespace otter_nav::mission
