// Guide paths between messages and the core.
#pragma once

#include <geometry_msgs/Point.h>
#include <otter_nav/GuidePath.h>

#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/topology/guide_path.hpp"

namespace otter_nav::ros_bridge {

[[nodiscard]] GuidePath toMessage(const Result<topology::GuidePath>& path, const ros::Time& stamp);

[[nodiscard]] std::vector<Eigen::Vector2d> toPoints(
    const std::vector<geometry_msgs::Point>& message);

}  // namespace otter_nav::ros_bridge
