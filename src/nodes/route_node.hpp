// route_node: goals sailed one after another through the action move_base, and a marker in rviz to
// set them with. No parameters.
#pragma once

#include <actionlib/client/simple_action_client.h>
#include <geometry_msgs/PoseArray.h>
#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"

namespace otter_nav::nodes {

class RouteNode {
 public:
  RouteNode();
  RouteNode(const RouteNode&) = delete;
  RouteNode& operator=(const RouteNode&) = delete;

 private:
  using Goals = std::vector<geometry_msgs::Pose>;

  void onAdd(const geometry_msgs::PoseStamped& goal);
  void onSet(const geometry_msgs::PoseArray& goals);
  void onOdometry(const nav_msgs::Odometry& message);
  void onMarker(const visualization_msgs::InteractiveMarkerFeedback& feedback);
  void serve(const std::string& name, Status (RouteNode::*wish)());
  void onDone(const actionlib::SimpleClientGoalState& state);

  [[nodiscard]] Status addMarker();
  [[nodiscard]] Status sail();
  // Takes the goals as the route; one that is sailed goes on if its goal is still the first.
  void setGoals(const Goals& goals);
  void sendFirst();
  void stopSailing(const std::string& reason);
  void showMarker(const geometry_msgs::Pose& pose);
  void publish();

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  Goals goals_;
  bool sailing_ = false;
  std::string reason_;
  bool marker_shown_ = false;
  geometry_msgs::Pose marker_;
  ros::Publisher route_publisher_;
  ros::Publisher marker_publisher_;
  actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction> client_;
  interactive_markers::InteractiveMarkerServer marker_server_;
  interactive_markers::MenuHandler menu_;
  std::vector<ros::ServiceServer> services_;
  ros::WallTimer next_;
  ros::Subscriber add_subscriber_;
  ros::Subscriber set_subscriber_;
  ros::Subscriber odometry_subscriber_;
};

}  // namespace otter_nav::nodes
