// map_node: the chart, and on top of it what the lidar sees, as an OctoMap and its projection.
// Parameters: config/map_node.yaml, the map's own under ~map (config/map.yaml).
#pragma once

#include <message_filters/subscriber.h>
#include <otter_nav/SaveMap.h>
#include <ros/node_handle.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>
#include <tf2_ros/transform_listener.h>

#include <memory>
#include <string>

#include "otter_nav/config/section.hpp"
#include "otter_nav/map/occupancy_map.hpp"
#include "otter_nav/ros/diagnostics.hpp"

namespace otter_nav::nodes {

class MapNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<MapNode>> create(config::Section section);
  [[nodiscard]] static int exitCode() { return 0; }

 private:
  explicit MapNode(map::OccupancyMap map);

  void onScan(const sensor_msgs::LaserScanConstPtr& message);
  void onGhosts(const sensor_msgs::PointCloud& message);
  [[nodiscard]] Result<map::CellRectangle> insert(const sensor_msgs::LaserScan& message);
  bool onSave(SaveMap::Request& request, SaveMap::Response& response);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  // An update is sent for every scan, of one unchanged cell if need be: it says that the scan has
  // been dealt with.
  void publishUpdate(map::CellRectangle changed, const ros::Time& stamp);
  void publishMapTo(const ros::SingleSubscriberPublisher& subscriber) const;

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  map::OccupancyMap map_;
  ros::Time load_time_;  // wall time, whatever the clock
  ros::Time last_scan_;

  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener transform_listener_{transforms_};
  message_filters::Subscriber<sensor_msgs::LaserScan> scan_subscriber_;
  tf2_ros::MessageFilter<sensor_msgs::LaserScan> scan_filter_;
  ros::Subscriber ghost_subscriber_;
  ros::Publisher map_publisher_;
  ros::Publisher chart_publisher_;
  ros::Publisher update_publisher_;
  ros::ServiceServer save_service_;
  ros::ServiceServer reset_service_;
};

}  // namespace otter_nav::nodes
