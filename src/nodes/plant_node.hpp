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
#include "otter_nav/config/fields.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "plant_publisher.hpp"

namespace otter_nav::nodes {

struct PlantNodeOptions {
  std::string vessel = "otter_gazebo";
  std::string disturbance = "paper";
  std::string scenario;
  int mission = 0;
  std::string world;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  int seed = 1;
  double control_period_s = 0.01;
  double speed = 1.0;
  bool lockstep = true;
  std::vector<std::string> lockstep_nodes = {"planner_node"};
  double lockstep_lag_s = 0.05;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("vessel", o.vessel, "a name of config/vessels, or a file");
    fields("disturbance", o.disturbance, "a preset of config/disturbances, or a file");
    fields("scenario", o.scenario, "file to take world and start from; empty: the two below");
    fields("mission", o.mission, {0.0, 1e6}, "of the scenario, counted from 0");
    fields("world", o.world, "map_server's YAML; empty: open water");
    fields.vector("start", o.start, {-1e6, 1e6}, "x m, y m, yaw rad; map frame, from east");
    fields("seed", o.seed, {0.0, 2147483647.0}, "of wind, waves and sensor noise");
    fields("control_period_s", o.control_period_s, {0.001, 0.1}, "between two commands");
    fields("speed", o.speed, {0.0, 1000.0}, "times real time; 0, in lockstep: as fast as it goes");
    fields("lockstep", o.lockstep, "time stands still until the control step's command has come");
    fields.texts("lockstep_nodes", o.lockstep_nodes, "have to acknowledge each scan as well");
    fields("lockstep_lag_s", o.lockstep_lag_s, {0.0, 1.0},
           "time may go on this far past a scan meanwhile");
  }
};

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
