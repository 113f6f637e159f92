// The main() of every node: parameters in, a wired node, spin; a wrong parameter ends the process
// with its reason and exit code 1.
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/String.h>

#include <optional>
#include <type_traits>
#include <vector>

#include "otter_nav/ros/clock_watch.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/live_parameters.hpp"
#include "otter_nav/ros/parameters.hpp"

namespace otter_nav::ros_bridge {

template <typename NodeClass, typename = void>
struct HasLiveParameters : std::false_type {};
template <typename NodeClass>
struct HasLiveParameters<NodeClass, std::void_t<decltype(std::declval<NodeClass&>().live())>>
    : std::true_type {};

// `NodeClass` offers `static Result<std::unique_ptr<NodeClass>> create(config::Section)`; and, if
// some of its parameters may change while it runs, `std::vector<config::NumberField> live()` and
// `Status change(config::Section)`.
template <typename NodeClass>
int runNode(int argc, char** argv, const char* name) {
  constexpr double kWaitS = 0.1;
  ros::init(argc, argv, name);
  ros::NodeHandle keep_alive;
  ros::NodeHandle own("~");
  // What it was told, and what of it changes, is part of a recording.
  const ros::Publisher parameters = own.advertise<std_msgs::String>("parameters", 1, true);
  if (const auto frames = readFrames(); !frames) {
    ROS_FATAL_STREAM(frames.error().message);
    ros::shutdown();
    return 1;
  }
  ClockWatch clock;
  while (true) {
    const auto node = readSection(own).and_then(
        [](const config::Section& section) { return NodeClass::create(section); });
    if (!node) {
      ROS_FATAL_STREAM(node.error().message);
      ros::shutdown();
      return 1;
    }
    std::optional<LiveParameters> live;
    if constexpr (HasLiveParameters<NodeClass>::value) {
      live.emplace((*node)->live(),
                   [&node](config::Section section) { return (*node)->change(std::move(section)); },
                   parameters);
    } else {
      live.emplace(
          std::vector<config::NumberField>(), [](const config::Section&) { return Status(); },
          parameters);
    }
    bool changed = false;
    while (ros::ok() && !changed) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kWaitS));
      changed = clock.changed();
    }
    if (!changed) {
      return (*node)->exitCode();
    }
  }
}

}  // namespace otter_nav::ros_bridge
