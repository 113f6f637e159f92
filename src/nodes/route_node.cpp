// route_node: goals sailed one after another through the action move_base, and a marker in rviz to
// set them with. No parameters.
#include <actionlib/client/simple_action_client.h>
#include <geometry_msgs/PoseArray.h>
#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Odometry.h>
#include <otter_nav/Route.h>
#include <ros/node_handle.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>
#include <string>
#include <vector>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/result.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/ros/frames.hpp"

namespace otter_nav::nodes {
namespace {

using Level = ros_bridge::Diagnostics::Level;
using ros_bridge::color;
using ros_bridge::frames;
using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::InteractiveMarkerFeedback;
using visualization_msgs::Marker;

constexpr char kMarker[] = "goal";
constexpr int kQueue = 10;
constexpr char kAllReached[] = "all goals reached";
constexpr double kMarkerAheadM = 10.0;  // of the vessel, where the marker is first shown

Marker arrow(const std_msgs::ColorRGBA& shade) {
  Marker marker;
  marker.type = Marker::ARROW;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = 3.0;
  marker.scale.y = 0.5;
  marker.scale.z = 0.5;
  marker.color = shade;
  return marker;
}

InteractiveMarkerControl control(const char* name, std::uint8_t mode) {
  InteractiveMarkerControl made;
  made.name = name;
  // The control's x axis points up: the plane of the water.
  made.orientation.w = std::sqrt(0.5);
  made.orientation.y = std::sqrt(0.5);
  made.interaction_mode = mode;
  return made;
}

InteractiveMarker goalMarker(const geometry_msgs::Pose& pose) {
  InteractiveMarker marker;
  marker.header.frame_id = frames().map;
  marker.name = kMarker;
  marker.description = "next goal: drag, turn; right click to sail";
  marker.scale = 5.0F;
  marker.pose = pose;
  InteractiveMarkerControl move = control("move", InteractiveMarkerControl::MOVE_PLANE);
  move.always_visible = 1;
  move.markers.push_back(arrow(color(0.85, 0.1, 0.55, 0.9)));
  Marker disc = arrow(color(0.85, 0.1, 0.55, 0.35));
  disc.type = Marker::CYLINDER;
  disc.scale.x = disc.scale.y = 2.4;
  disc.scale.z = 0.05;
  move.markers.push_back(disc);
  marker.controls.push_back(move);
  marker.controls.push_back(control("turn", InteractiveMarkerControl::ROTATE_AXIS));
  return marker;
}

bool same(const geometry_msgs::Pose& a, const geometry_msgs::Pose& b) {
  return a.position.x == b.position.x && a.position.y == b.position.y &&
         a.orientation.z == b.orientation.z && a.orientation.w == b.orientation.w;
}

}  // namespace

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
  ros_bridge::Diagnostics diagnostics_{node_, private_node_, "route"};
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

RouteNode::RouteNode()
    : route_publisher_(node_.advertise<Route>("route", kQueue, true)),
      marker_publisher_(
          node_.advertise<visualization_msgs::MarkerArray>("route_markers", kQueue, true)),
      client_(node_, "move_base", false),
      marker_server_("goal_marker") {
  menu_.insert("Sail there", [this](const auto& feedback) {
    marker_ = feedback->pose;
    setGoals({marker_});
    const Status status = sailing_ ? Status() : sail();
    if (!status) {
      stopSailing(status.error().message);
    }
  });
  menu_.insert("Add to the goals", [this](const auto& feedback) {
    marker_ = feedback->pose;
    (void)addMarker();
  });
  add_subscriber_ = node_.subscribe("route/add", 10, &RouteNode::onAdd, this);
  set_subscriber_ = node_.subscribe("route/set", 10, &RouteNode::onSet, this);
  odometry_subscriber_ = node_.subscribe("odom", 1, &RouteNode::onOdometry, this);
  serve("add_marker", &RouteNode::addMarker);
  serve("sail", &RouteNode::sail);
  publish();
}

void RouteNode::serve(const std::string& name, Status (RouteNode::*wish)()) {
  const auto answer = [this, wish](std_srvs::Trigger::Request&,
                                   std_srvs::Trigger::Response& response) {
    const Status status = (this->*wish)();
    response.success = static_cast<std::uint8_t>(status.has_value());
    response.message = status ? "" : status.error().message;
    return true;
  };
  services_.push_back(
      private_node_.advertiseService<std_srvs::Trigger::Request, std_srvs::Trigger::Response>(
          name, answer));
}

void RouteNode::onOdometry(const nav_msgs::Odometry& message) {
  const auto vessel = ros_bridge::planarPose(message.pose.pose);
  if (!vessel) {
    diagnostics_.refuse("odom", vessel.error().message);
    return;
  }
  const Eigen::Vector2d ahead = unitVector(vessel->psi_rad);
  showMarker(ros_bridge::toPose({vessel->position + kMarkerAheadM * ahead, vessel->psi_rad}));
  odometry_subscriber_.shutdown();
}

void RouteNode::showMarker(const geometry_msgs::Pose& pose) {
  marker_ = pose;
  marker_server_.insert(goalMarker(pose), [this](const auto& feedback) { onMarker(*feedback); });
  menu_.apply(marker_server_, kMarker);
  marker_server_.applyChanges();
  marker_shown_ = true;
}

void RouteNode::onMarker(const InteractiveMarkerFeedback& feedback) {
  marker_ = feedback.pose;
}

void RouteNode::onAdd(const geometry_msgs::PoseStamped& goal) {
  if (const auto pose = ros_bridge::planarPose(goal, frames().map); !pose) {
    diagnostics_.refuse("route/add", pose.error().message);
    return;
  }
  Goals goals = goals_;
  goals.push_back(goal.pose);
  setGoals(goals);
}

void RouteNode::onSet(const geometry_msgs::PoseArray& goals) {
  for (const geometry_msgs::Pose& goal : goals.poses) {
    geometry_msgs::PoseStamped stamped;
    stamped.header = goals.header;
    stamped.pose = goal;
    if (const auto pose = ros_bridge::planarPose(stamped, frames().map); !pose) {
      diagnostics_.refuse("route/set", pose.error().message);
      return;
    }
  }
  setGoals(goals.poses);
}

Status RouteNode::addMarker() {
  if (!marker_shown_) {
    return failure("there is no marker yet: no odometry came");
  }
  Goals goals = goals_;
  goals.push_back(marker_);
  setGoals(goals);
  return {};
}

void RouteNode::setGoals(const Goals& goals) {
  const bool goes_on = !goals.empty() && !goals_.empty() && same(goals.front(), goals_.front());
  goals_ = goals;
  reason_.clear();
  if (sailing_ && goals_.empty()) {
    client_.cancelGoal();
    sailing_ = false;
  } else if (sailing_ && !goes_on) {
    sendFirst();
  }
  publish();
}

Status RouteNode::sail() {
  if (goals_.empty()) {
    return failure("there are no goals to sail to");
  }
  if (!client_.isServerConnected()) {
    return failure("nobody offers the action move_base");
  }
  sailing_ = true;
  reason_.clear();
  sendFirst();
  publish();
  return {};
}

void RouteNode::sendFirst() {
  move_base_msgs::MoveBaseGoal goal;
  goal.target_pose.header.frame_id = frames().map;
  goal.target_pose.header.stamp = ros::Time::now();
  goal.target_pose.pose = goals_.front();
  client_.sendGoal(
      goal, [this](const actionlib::SimpleClientGoalState& state, const auto&) { onDone(state); });
}

// The goals left are kept, whatever happened, so that the route can be taken up again.
void RouteNode::onDone(const actionlib::SimpleClientGoalState& state) {
  if (!sailing_) {
    return;
  }
  if (state != actionlib::SimpleClientGoalState::SUCCEEDED) {
    stopSailing(state.getText().empty() ? state.toString() : state.getText());
    return;
  }
  goals_.erase(goals_.begin());
  if (goals_.empty()) {
    stopSailing(kAllReached);
    return;
  }
  publish();
  // Not from within the client's own callback.
  next_ = node_.createWallTimer(
      ros::WallDuration(0.0),
      [this](const ros::WallTimerEvent&) {
        if (sailing_) {
          sendFirst();
        }
      },
      true);
}

void RouteNode::stopSailing(const std::string& reason) {
  sailing_ = false;
  reason_ = reason;
  publish();
}

void RouteNode::publish() {
  const bool gave_up = !sailing_ && !reason_.empty() && reason_ != kAllReached;
  diagnostics_.setState(gave_up ? Level::kWarning : Level::kOk, sailing_ ? "sailing"
                                                                : reason_.empty()
                                                                    ? "waiting for goals"
                                                                    : reason_);
  Route route;
  route.header.frame_id = frames().map;
  route.header.stamp = ros::Time::now();
  route.goals = goals_;
  route.sailing = static_cast<std::uint8_t>(sailing_);
  route.reason = reason_;
  route_publisher_.publish(route);

  visualization_msgs::MarkerArray markers;
  Marker clear;
  clear.header.frame_id = frames().map;
  clear.action = Marker::DELETEALL;
  markers.markers.push_back(clear);
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    Marker marker = arrow(color(0.6, 0.05, 0.4, 0.8));
    marker.header.frame_id = frames().map;
    marker.ns = "goals";
    marker.id = static_cast<int>(2 * i);
    marker.pose = goals_[i];
    markers.markers.push_back(marker);
    marker.type = Marker::TEXT_VIEW_FACING;
    marker.id += 1;
    marker.scale.z = 2.0;
    marker.pose.position.z = 2.0;
    marker.text = std::to_string(i + 1);
    markers.markers.push_back(marker);
  }
  marker_publisher_.publish(markers);
}

}  // namespace otter_nav::nodes

int main(int argc, char** argv) {
  ros::init(argc, argv, "route_node");
  const ros::NodeHandle keep_alive;
  if (const auto frames = otter_nav::ros_bridge::readFrames(); !frames) {
    ROS_FATAL_STREAM(frames.error().message);
    return 1;
  }
  const otter_nav::nodes::RouteNode node;
  ros::spin();
  return 0;
}
