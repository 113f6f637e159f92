// plant_node: the vessel in its world behind the topics a real one has. Parameters:
// config/plant_node.yaml, the plant's own under ~plant (config/plant.yaml).
#pragma once

#include <otter_nav/ThrusterCommand.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "lockstep_gate.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "plant_node_options.hpp"
#include "plant_publisher.hpp"

namespace otter_nav::nodes {

class PlantNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<PlantNode>> create(config::Section section);
  ~PlantNode();
  PlantNode(const PlantNode&) = delete;
  PlantNode& operator=(const PlantNode&) = delete;

  [[nodiscard]] int exitCode() const { return exit_code_; }

 private:
  PlantNode(PlantNodeOptions options, plant::Simulator simulator);

  void onCommand(const ThrusterCommand& message);
  void onAcknowledgement(const std_msgs::Header& message);
  void run();
  void publishStep();
  // These return false when the node is to end.
  bool waitForNodes(const ros::Time& now);
  bool takeCommand();
  // Waits until `ready`, which itself waits a little; `what` says what for.
  bool waitPatiently(const std::function<bool()>& ready, const std::function<std::string()>& what);

  PlantNodeOptions options_;
  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  plant::Simulator simulator_;
  PlantPublisher publisher_;
  LockstepGate gate_;
  ros::Time now_;
  std::vector<ros::Time> pending_scans_;
  ros::Subscriber command_subscriber_;
  ros::Subscriber acknowledgement_subscriber_;
  std::atomic<int> exit_code_{0};
  std::thread thread_;
};

}  // namespace otter_nav::nodes
