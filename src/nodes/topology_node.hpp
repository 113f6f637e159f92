// topology_node: guide paths on the map as it is known (paper, section IV-A). Parameters:
// config/topology_node.yaml, the search's own under ~topology (config/topology.yaml).
#pragma once

#include <otter_nav/FindGuidePath.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <condition_variable>
#include <memory>
#include <mutex>

#include "otter_nav/config/section.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/ros/map_mirror.hpp"
#include "otter_nav/topology/guide_path.hpp"

namespace otter_nav::nodes {

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

}  // namespace otter_nav::nodes
