// A lidar's scans, and where the lidar is.
#pragma once

#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/buffer.h>

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/base/scan.hpp"
#include "otter_nav/map/occupancy_map.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::ros_bridge {

[[nodiscard]] Scan toScan(const sensor_msgs::LaserScan& message);
// A frame's pose in the map frame, or what tf says instead.
[[nodiscard]] Result<map::SensorPose> poseInMap(const tf2_ros::Buffer& transforms,
                                                const std::string& frame, const ros::Time& stamp);
// The hull's, in the plane.
[[nodiscard]] Result<vessel::Pose> hullInMap(const tf2_ros::Buffer& transforms,
                                             const ros::Time& stamp);

}  // namespace otter_nav::ros_bridge
