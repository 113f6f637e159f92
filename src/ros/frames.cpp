#include "otter_nav/ros/frames.hpp"

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

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
  return frames;
}

const Frames& frames() {
  static const Frames kFrames = readFrames().value_or(Frames());
  return kFrames;
}

}  // namespace otter_nav::ros_bridge
