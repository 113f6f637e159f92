// The frames of the project (REP-105; docs/frames.md).
#pragma once

namespace otter_nav::ros_bridge {

constexpr const char* kMapFrame = "map";
constexpr const char* kOdomFrame = "odom";
constexpr const char* kBaseFrame = "base_link";
constexpr const char* kLidarFrame = "lidar";

}  // namespace otter_nav::ros_bridge
