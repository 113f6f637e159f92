// excitation_node: sails the excitation manoeuvres, a thruster command for each odometry message,
// and ends when they are done. Parameters: config/excitation.yaml and those of
// launch/collect.launch.
#pragma once

#include <nav_msgs/Odometry.h>
#include <otter_nav/ThrusterCommand.h>
#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <vector>

#include "otter_nav/config/section.hpp"
#include "otter_nav/identification/manoeuvres.hpp"
#include "otter_nav/ros/diagnostics.hpp"

namespace otter_nav::nodes {

struct ExcitationNodeOptions {
  std::string vessel;  // a name of config/vessels, or a file
  // Nothing moves before so many listen to the commands: the plant and the recorder.
  int listeners = 2;
};

class ExcitationNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<ExcitationNode>> create(config::Section section);
  [[nodiscard]] static int exitCode() { return 0; }

 private:
  ExcitationNode(ExcitationNodeOptions options,
                 std::vector<identification::ManoeuvreOptions> manoeuvres,
                 const vessel::Parameters& vessel);

  void onOdometry(const nav_msgs::Odometry& message);
  void reportProgress();

  ExcitationNodeOptions options_;
  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  identification::Excitation excitation_;
  std::string progress_;
  ThrusterCommand command_;
  ros::Publisher command_publisher_;
  ros::Subscriber odometry_subscriber_;
};

}  // namespace otter_nav::nodes
