// From poses to a slow way that the hull follows exactly: straight legs from rest to rest with the
// heading held, ahead or astern, and turns on the spot.
#pragma once

#include <vector>

#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::planner {

// `poses` as HullSearch gives them. Within a part of the limits' thrust, so that the tracker has
// the rest to stay on it, and at a walk; not verified.
[[nodiscard]] trajectory::Trajectory creepAlong(const std::vector<vessel::Pose>& poses,
                                                const vessel::Parameters& vessel,
                                                const feasibility::SafetyLimits& limits);

}  // namespace otter_nav::planner
