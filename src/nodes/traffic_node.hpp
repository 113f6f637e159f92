// traffic_node: tracks of other vessels from lidar, radar and AIS, and the scan without them for
// the map. Parameters: config/traffic_node.yaml, the tracker's own under ~traffic
// (config/traffic.yaml).
#pragma once

#include <geometry_msgs/PoseArray.h>
#include <message_filters/subscriber.h>
#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/String.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_listener.h>

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "otter_nav/config/section.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/traffic/tracker.hpp"

namespace otter_nav::nodes {

// Everything happens with a scan: what other sensors told since the scan before is taken first, so
// that a run in lockstep doesn't depend on which message was quicker.
class TrafficNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<TrafficNode>> create(config::Section section);
  [[nodiscard]] static int exitCode() { return 0; }

 private:
  TrafficNode(const traffic::Options& options, const vessel::Hull& hull);

  void onChart(const nav_msgs::OccupancyGrid& message);
  void onScan(const sensor_msgs::LaserScanConstPtr& message);
  void onRadar(const geometry_msgs::PoseArray& message);
  void onAis(const std_msgs::String& message);
  void takeOthers();
  void publishGhosts(const ros::Time& stamp, const std::vector<Eigen::Vector2d>& ghosts);
  void publish(const ros::Time& stamp);

  // What came between two scans.
  struct Heard {
    ros::Time stamp;
    bool is_radar = false;
    std::vector<Eigen::Vector2d> radar_in_base;
    std::string ais;
  };

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  traffic::Options options_;
  vessel::Hull hull_;
  traffic::Tracker tracker_;
  std::deque<Heard> heard_;
  ros::Time last_scan_;
  sensor_msgs::LaserScan last_still_;

  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener transform_listener_{transforms_};
  message_filters::Subscriber<sensor_msgs::LaserScan> scan_subscriber_;
  tf2_ros::MessageFilter<sensor_msgs::LaserScan> scan_filter_;
  ros::Subscriber chart_subscriber_;
  ros::Subscriber radar_subscriber_;
  ros::Subscriber ais_subscriber_;
  ros::Publisher tracks_publisher_;
  ros::Publisher markers_publisher_;
  ros::Publisher still_publisher_;
  ros::Publisher ghosts_publisher_;
};

}  // namespace otter_nav::nodes
