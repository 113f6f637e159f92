#include "otter_nav/ros/frames.hpp"

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace otter_nav::ros_bridge {

Result<Frames> readFrames() {
  const ros::NodeHandle node;
  Frames frames;
  std::string key;
  XmlRpc::XmlRpcValue told;
  if (!node.searchParam("frames", key) || !node.getParam(key, told)) {
    return frames;
  }
  if (told.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    return failure("parameter '" + key + "' has to be like {map: world, base: hull}");
  }
  const std::map<std::string, std::string*> known = {{"map", &frames.map},
                                                     {"odom", &frames.odom},
                                                     {"base", &frames.base},
                                                     {"lidar", &frames.lidar}};
  for (auto& [name, value] : told) {
    const auto frame = known.find(name);
    if (frame == known.end()) {
      return failure("parameter '" + key + "/" + name + "': the frames are map, odom, base, lidar");
    }
    if (value.getType() != XmlRpc::XmlRpcValue::TypeString ||
        static_cast<std::string>(value).empty()) {
      return failure("parameter '" + key + "/" + name + "' is no name");
    }
    *frame->second = static_cast<std::string>(value);
  }
  for (auto frame = known.begin(); frame != known.end(); ++frame) {
    const auto same = std::find_if(std::next(frame), known.end(), [&](const auto& other) {
      return *other.second == *frame->second;
    });
    if (same != known.end()) {
      return failure("parameter '" + key + "': " + frame->first + " and " + same->first +
                     " are both '" + *frame->second + "', but need names of their own");
    }
  }
  return frames;
}

const Frames& frames() {
  static const Frames kFrames = readFrames().value_or(Frames());
  return kFrames;
}

}  // namespace otter_nav::ros_bridge
