// Guide path, trees and trajectory for rviz.
#pragma once

#include <otter_nav/GuidePath.h>
#include <visualization_msgs/MarkerArray.h>

#include "otter_nav/planner/planner.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::ros_bridge {

// The path, its points with the corridor's circles, and the Dubins curve.
[[nodiscard]] visualization_msgs::MarkerArray guidePathMarkers(const GuidePath& path);
// Both trees: from the start and from the goal, in two colours.
[[nodiscard]] visualization_msgs::MarkerArray treeMarkers(const planner::Plan& plan);
// A ribbon coloured by speed, from blue at rest to red at the vessel's top speed.
[[nodiscard]] visualization_msgs::MarkerArray trajectoryMarkers(
    const trajectory::Trajectory& trajectory, const vessel::Parameters& vessel);

}  // namespace otter_nav::ros_bridge
