// tracker_node: keeps the vessel on the planner's trajectory. Parameters:
// config/tracker_node.yaml, the tracker's own under ~tracker (config/tracker.yaml).
#pragma once

#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <otter_nav/ThrusterCommand.h>
#include <otter_nav/TrackerCycle.h>
#include <otter_nav/TrackerStatus.h>
#include <otter_nav/Trajectory.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "control_loop.hpp"
#include "cycle_statistics.hpp"
#include "otter_nav/config/field_list.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "tracker_node_options.hpp"

namespace otter_nav::nodes {

class TrackerNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<TrackerNode>> create(config::Section section);
  [[nodiscard]] static int exitCode() { return 0; }

  // What may change while it runs.
  [[nodiscard]] std::vector<config::NumberField> live() const;
  [[nodiscard]] Status change(config::Section section);

 private:
  TrackerNode(TrackerNodeOptions options, const tracker::Options& tracker,
              const vessel::Parameters& vessel);

  void onTrajectory(const Trajectory& message);
  void onOdometry(const nav_msgs::Odometry& message);
  void begin();
  // Lockstep: the command for the odometry's stamp.
  void controlStep(const ros::Time& stamp);
  // How late a step that began `now` is on the beat of simulated time.
  [[nodiscard]] double latenessMs(const ros::WallTime& now);
  void publish(const ControlOutput& output);
  void publishCycle(const tracker::Command& command);
  void publishPrediction(const tracker::Prediction& prediction);
  void publishStatus();
  [[nodiscard]] TrackerStatus status() const;

  TrackerNodeOptions options_;
  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  tracker::Tracker tracker_;
  double period_s_;
  CycleStatistics statistics_;

  // What the status tells; `mutex_` guards it, the control loop stays away from it.
  mutable std::mutex mutex_;
  tracker::Command last_command_;
  double told_s_ = -1.0;  // its time
  ThrusterCommand command_message_;
  TrackerCycle cycle_message_;
  std::uint32_t in_force_id_ = 0;
  std::uint32_t accepted_id_ = 0;
  double accepted_start_s_ = 0.0;
  std::uint32_t refused_id_ = 0;
  std::string refused_reason_;

  bool begun_ = false;  // not before it is recorded, where it shall be
  ros::Time last_odometry_;
  int lockstep_steps_ = 0;
  ros::WallTime next_turn_;

  ros::Publisher command_publisher_;
  ros::Publisher status_publisher_;
  ros::Publisher cycle_publisher_;
  ros::Publisher vessel_publisher_;
  ros::Publisher prediction_publisher_;
  ros::Subscriber trajectory_subscriber_;
  ros::Subscriber odometry_subscriber_;
  ros::Subscriber recording_subscriber_;
  ros::WallTimer status_timer_;
  std::unique_ptr<ControlLoop> loop_;  // absent in lockstep
};

}  // namespace otter_nav::nodes
