#include "otter_nav/ros/frames.hpp"

#include <ros/node_handle.h>

#include "otter_nav/ros/parameters.hpp"

namespace otter_nav::ros_bridge {

Result<Frames> readFrames() {
  const ros::NodeHandle node;
  std::string key;
  if (!node.searchParam("frames", key)) {
    return Frames();
  }
  return readSection(ros::NodeHandle(key)).and_then([&](const config::Section& section) {
    return config::read<Frames>(section).and_then([&](const Frames& read) -> Result<Frames> {
      for (const std::string* name : {&read.map, &read.odom, &read.base, &read.lidar}) {
        if (name->empty()) {
          return failure(key + ": a frame's name is empty");
        }
      }
      return read;
    });
  });
}

const Frames& frames() {
  static const Frames kFrames = readFrames().value_or(Frames());
  return kFrames;
}

}  // namespace otter_nav::ros_bridge
