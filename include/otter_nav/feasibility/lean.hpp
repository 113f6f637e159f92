// The attitude of a hull that keeps to a path in a load from abeam. It has no thruster against
// that: the tracker turns it until what pushes it along takes the load up, in a light one by more
// than half a radian at a crawl, in strong wind nearly to the bow into it. A plan for still water
// knows nothing of it, and its corners are where it matters.
#pragma once

#include <Eigen/Core>

#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::feasibility {

// What is kept beside the leaning outline, at most: waves are the planned attitude's to leave room
// for.
inline constexpr double kLeaningMarginM = 0.02;

// Whether a hull leans into it by anything that counts.
[[nodiscard]] bool leansInto(const vessel::Parameters& vessel, const vessel::Disturbance& felt);

// The unit vector ahead of the hull that is planned to lie along `ahead`, as the tracker's
// reference has it (vessel::swayHeading) on a path with that velocity and acceleration.
[[nodiscard]] Eigen::Vector2d leaningBow(const vessel::Parameters& vessel,
                                         const vessel::Disturbance& felt,
                                         const Eigen::Vector2d& velocity,
                                         const Eigen::Vector2d& acceleration,
                                         const Eigen::Vector2d& ahead);

}  // namespace otter_nav::feasibility
