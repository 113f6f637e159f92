// topology_node: guide paths on the map as it is known (paper, section IV-A). Parameters:
// config/topology_node.yaml, the search's own under ~topology (config/topology.yaml).
#include <otter_nav/FindGuidePath.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/spinner.h>
#include <visualization_msgs/MarkerArray.h>

#include <condition_variable>
#include <memory>
#include <mutex>

#include "map_options.hpp"
#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/guide_paths.hpp"
#include "otter_nav/ros/map_mirror.hpp"
#include "otter_nav/ros/plan_markers.hpp"
#include "otter_nav/ros/run_node.hpp"
#include "otter_nav/topology/guide_path.hpp"

namespace otter_nav::nodes {
namespace {

using Level = ros_bridge::Diagnostics::Level;

constexpr int kQueue = 50;
constexpr std::chrono::seconds kMapPatience{1};

Result<vessel::Pose> toPose(const geometry_msgs::PoseStamped& message, const char* what) {
  return ros_bridge::planarPose(message, ros_bridge::frames().map)
      .map_error([&](const Error& error) { return Error{what + (": " + error.message)}; });
}

}  // namespace

// The map is taken in the main thread, requests are answered in another: a request may wait for
// the map.
class TopologyNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<TopologyNode>> create(config::Section section);
  ~TopologyNode();
  TopologyNode(const TopologyNode&) = delete;
  TopologyNode& operator=(const TopologyNode&) = delete;
  [[nodiscard]] static int exitCode() { return 0; }

 private:
  TopologyNode(const map::DistanceFieldOptions& field, const topology::Options& options);

  void onMap(const nav_msgs::OccupancyGrid& message);
  void onUpdate(const map_msgs::OccupancyGridUpdate& message);
  bool onRequest(FindGuidePath::Request& request, FindGuidePath::Response& response);
  [[nodiscard]] Result<topology::GuidePath> find(const FindGuidePath::Request& request);

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;

  std::mutex mutex_;  // of the map
  std::condition_variable map_changed_;
  ros_bridge::MapMirror map_;
  topology::GuidePathFinder finder_;

  ros::Subscriber map_subscriber_;
  ros::Subscriber update_subscriber_;
  ros::Publisher path_publisher_;
  ros::Publisher marker_publisher_;
  ros::CallbackQueue requests_;
  ros::NodeHandle request_node_;
  ros::ServiceServer service_;
  ros::AsyncSpinner request_spinner_{1, &requests_};
};

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
  path_publisher_ = node_.advertise<GuidePath>("guide_path", kQueue, true);
  marker_publisher_ =
      node_.advertise<visualization_msgs::MarkerArray>("guide_path_markers", kQueue, true);
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
  const Result<vessel::Pose> start = toPose(request.start, "start");
  if (!start) {
    return failure(start.error().message);
  }
  const Result<vessel::Pose> goal = toPose(request.goal, "goal");
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

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::TopologyNode>(argc, argv,
                                                                        "topology_node");
}
