#include "otter_nav/ros/guide_paths.hpp"

#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"

namespace otter_nav::ros_bridge {

GuidePath toMessage(const Result<topology::GuidePath>& path, const ros::Time& stamp) {
  GuidePath message;
  message.header.frame_id = frames().map;
  message.header.stamp = stamp;
  message.found = static_cast<std::uint8_t>(path.has_value());
  if (!path) {
    message.reason = path.error().message;
    return message;
  }
  message.length = path->length_m;
  message.corridor_radii = path->corridor_m;
  for (const Eigen::Vector2d& point : path->points) {
    message.points.push_back(toPoint(point));
  }
  for (const topology::Pose& pose : path->dubins) {
    message.dubins.push_back(toPoint(pose.position));
  }
  for (const Eigen::Vector2d& point : path->pushed_points) {
    message.pushed_points.push_back(toPoint(point));
  }
  return message;
}

std::vector<Eigen::Vector2d> toPoints(const std::vector<geometry_msgs::Point>& message) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(message.size());
  for (const geometry_msgs::Point& point : message) {
    points.emplace_back(point.x, point.y);
  }
  return points;
}

}  // namespace otter_nav::ros_bridge
