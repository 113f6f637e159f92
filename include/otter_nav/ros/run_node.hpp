// The main() of every node: parameters in, a wired node, spin; a wrong parameter ends the process
// with its reason and exit code 1.
#pragma once

#include <ros/ros.h>
#include <std_msgs/String.h>

#include <memory>

#include "otter_nav/ros/parameters.hpp"

namespace otter_nav::ros_bridge {

// `NodeClass` offers `static Result<std::unique_ptr<NodeClass>> create(config::Section)`.
template <typename NodeClass>
int runNode(int argc, char** argv, const char* name) {
  ros::init(argc, argv, name);
  ros::NodeHandle keep_alive;
  ros::NodeHandle own("~");
  const auto node = readSection(own).and_then(
      [](const config::Section& section) { return NodeClass::create(section); });
  if (!node) {
    ROS_FATAL_STREAM(node.error().message);
    ros::shutdown();
    return 1;
  }
  // What it was told is part of a recording.
  const ros::Publisher parameters = own.advertise<std_msgs::String>("parameters", 1, true);
  std_msgs::String text;
  text.data = parametersText(own);
  parameters.publish(text);
  ros::spin();
  return (*node)->exitCode();
}

}  // namespace otter_nav::ros_bridge
