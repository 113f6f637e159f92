#include "topology_node.hpp"

#include <ros/service_server.h>
#include <visualization_msgs/MarkerArray.h>

#include "map_options.hpp"
#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/guide_paths.hpp"
#include "otter_nav/ros/plan_markers.hpp"

namespace otter_nav::nodes {
namespace {

using Level = ros_bridge::Diagnostics::Level;

constexpr int kQueue = 50;
constexpr std::chrono::seconds kMapPatience{1};

Result<topology::Pose> toPose(const geometry_msgs::PoseStamped& message, const char* what) {
  return ros_bridge::planarPose(message, ros_bridge::frames().map)
      .map([](const vessel::Pose& pose) {
        return topology::Pose{pose.position, pose.psi_rad};
      })
      .map_error([&](const Error& error) { return Error{what + (": " + error.message)}; });
}

}  // namespace

Result<std::unique_ptr<TopologyNode>> TopologyNode::create(config::Section section) {
  TopologyNodeOptions node;
  const Status fields = config::readFields(section, node);
  const Result<topology::Options> options =
      config::read<topology::Options>(section.child("topology"));
  if (const Status status = firstFailure(fields, section.finish(), options); !status) {
    return failure(status.error().message);
  }
  return std::unique_ptr<TopologyNode>(new TopologyNode(node.distance_field, *options));
}

TopologyNode::TopologyNode(const map::DistanceFieldOptions& field, const topology::Options& options)
    : diagnostics_(node_, private_node_, "topology"), map_(field), finder_(options) {
  path_publisher_ = node_.advertise<GuidePath>("guide_path", 1, true);
  marker_publisher_ =
      node_.advertise<visualization_msgs::MarkerArray>("guide_path_markers", 1, true);
  diagnostics_.setState(Level::kWarning, "waiting for the map");
  map_subscriber_ = node_.subscribe("map", 1, &TopologyNode::onMap, this);
  update_subscriber_ = node_.subscribe("map_updates", kQueue, &TopologyNode::onUpdate, this,
                                       ros::TransportHints().tcpNoDelay());
  request_node_.setCallbackQueue(&requests_);
  service_ = request_node_.advertiseService("find_guide_path", &TopologyNode::onRequest, this);
  request_spinner_.start();
}

TopologyNode::~TopologyNode() {
  request_spinner_.stop();
}

void TopologyNode::onMap(const nav_msgs::OccupancyGrid& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const Status status = map_.take(message); !status) {
    diagnostics_.refuse("map", status.error().message);
    return;
  }
  diagnostics_.setState(Level::kOk, "ready");
  map_changed_.notify_all();
}

void TopologyNode::onUpdate(const map_msgs::OccupancyGridUpdate& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (const auto changed = map_.take(message); !changed) {
    diagnostics_.refuse("map_updates", changed.error().message);
  }
  map_changed_.notify_all();
}

bool TopologyNode::onRequest(FindGuidePath::Request& request, FindGuidePath::Response& response) {
  const Result<topology::GuidePath> path = find(request);
  response.guide_path = ros_bridge::toMessage(path, ros::Time::now());
  path_publisher_.publish(response.guide_path);
  marker_publisher_.publish(ros_bridge::guidePathMarkers(response.guide_path));
  return true;
}

Result<topology::GuidePath> TopologyNode::find(const FindGuidePath::Request& request) {
  const Result<topology::Pose> start = toPose(request.start, "start");
  if (!start) {
    return failure(start.error().message);
  }
  const Result<topology::Pose> goal = toPose(request.goal, "goal");
  if (!goal) {
    return failure(goal.error().message);
  }
  std::unique_lock<std::mutex> lock(mutex_);
  if (!map_changed_.wait_for(lock, kMapPatience,
                             [&] { return map_.ready() && map_.stamp() >= request.map_stamp; })) {
    return failure(map_.ready() ? "the map is older than asked for" : "there is no map yet");
  }
  return finder_.find(map_.field(), *start, *goal,
                      request.clearance > 0.0 ? request.clearance : topology::kNarrowestM);
}

}  // namespace otter_nav::nodes
