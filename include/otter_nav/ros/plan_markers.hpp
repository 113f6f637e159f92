// Guide path, trees and trajectory for rviz.
#pragma once

#include <otter_nav/GuidePath.h>
#include <visualization_msgs/MarkerArray.h>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::ros_bridge {

// The path, its points with the corridor's circles, and the Dubins curve.
[[nodiscard]] visualization_msgs::MarkerArray guidePathMarkers(const GuidePath& path);
// Both trees: from the start and from the goal, in two colours.
[[nodiscard]] visualization_msgs::MarkerArray treeMarkers(const planner::Plan& plan);
// A line coloured by speed, as a share of the vessel's top speed (speed_colour.hpp).
[[nodiscard]] visualization_msgs::MarkerArray trajectoryMarkers(
    const trajectory::Trajectory& trajectory, const vessel::Parameters& vessel);
// A ribbon as wide as the clearance the plan keeps to either side; where the map has less by now it
// has another colour. Nothing for a manoeuvre without a plan (0 m).
[[nodiscard]] visualization_msgs::MarkerArray clearanceMarkers(
    const trajectory::Trajectory& trajectory, double clearance_m, const map::DistanceField& field);
[[nodiscard]] visualization_msgs::MarkerArray goalMarkers(const vessel::Pose& goal);

}  // namespace otter_nav::ros_bridge
