// Where the vessel has been, as a path that is published now and then.
#pragma once

#include <nav_msgs/Path.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <Eigen/Core>

namespace otter_nav::ros_bridge {

class Trail {
 public:
  Trail(ros::NodeHandle& node, const std::string& topic)
      : publisher_(node.advertise<nav_msgs::Path>(topic, 1, true)) {}

  // Adds a point each kSpacingM, and publishes each kEvery points.
  void add(const geometry_msgs::Pose& pose, const std::string& frame, const ros::Time& stamp) {
    const Eigen::Vector2d position(pose.position.x, pose.position.y);
    if (!path_.poses.empty() && (position - last_).norm() < kSpacingM) {
      return;
    }
    last_ = position;
    path_.header.frame_id = frame;
    path_.header.stamp = stamp;
    geometry_msgs::PoseStamped point;
    point.header = path_.header;
    point.pose = pose;
    path_.poses.push_back(point);
    if (path_.poses.size() > kSize) {
      path_.poses.erase(path_.poses.begin(), path_.poses.begin() + kSize / 2);
    }
    if (path_.poses.size() % kEvery == 1) {
      publisher_.publish(path_);
    }
  }

 private:
  static constexpr double kSpacingM = 0.3;
  static constexpr std::size_t kEvery = 4;
  static constexpr std::size_t kSize = 10000;
  ros::Publisher publisher_;
  nav_msgs::Path path_;
  Eigen::Vector2d last_ = Eigen::Vector2d::Zero();
};

}  // namespace otter_nav::ros_bridge
