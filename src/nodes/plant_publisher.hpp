// Everything the plant tells the world, as messages.
#pragma once

#include <nav_msgs/Odometry.h>
#include <otter_nav/PlantState.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "otter_nav/base/scan.hpp"
#include "otter_nav/plant/simulator.hpp"
#include "otter_nav/ros/trail.hpp"

namespace otter_nav::nodes {

class PlantPublisher {
 public:
  PlantPublisher(ros::NodeHandle& node, const plant::LidarOptions& lidar);

  // Clock, transform, odometry and truth at `stamp`; contact when it begins and ends.
  void publish(const plant::Simulator& simulator, const ros::Time& stamp);
  void publishScan(const Scan& scan, const ros::Time& stamp);
  void publishRadar(const std::vector<Eigen::Vector2d>& radar_in_base, const ros::Time& stamp);
  void publishAis(const std::vector<std::string>& sentences);
  // The last of clock, odometry, state and scan once more, for whoever was not there
  // yet.
  void repeat();

 private:
  void publishOdometry(const plant::Simulator& simulator, const ros::Time& stamp);
  void publishTruth(const plant::Simulator& simulator, const ros::Time& stamp);
  void publishWeather(const plant::Truth& truth, const ros::Time& stamp);
  void publishContact(const plant::Simulator& simulator, const ros::Time& stamp);
  void publishVessels(const plant::Simulator& simulator, const ros::Time& stamp);

  ros::Publisher clock_;
  ros::Publisher odometry_;
  ros::Publisher ground_truth_;
  ros::Publisher state_;
  ros::Publisher scan_;
  ros::Publisher radar_;
  ros::Publisher ais_;
  ros::Publisher vessels_;
  ros::Publisher contact_;
  ros::Publisher wind_;
  ros::Publisher current_;
  ros_bridge::Trail trail_;
  ros::Publisher transforms_;  // latched, as time may stand still when somebody comes
  tf2_ros::StaticTransformBroadcaster static_transforms_;

  nav_msgs::Odometry last_odometry_;
  sensor_msgs::LaserScan last_scan_;
  PlantState last_state_;
  bool in_contact_ = false;
  ros::Time next_weather_;
};

}  // namespace otter_nav::nodes
