#include "otter_nav/ros/parameters.hpp"

#include <ros/this_node.h>

#include <array>
#include <charconv>

namespace otter_nav::ros_bridge {
namespace {

// As few digits as say the same number.
std::string allDigits(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.begin(), text.end(), value).ptr;
  return {text.begin(), end};
}

Result<YAML::Node> listToYaml(XmlRpc::XmlRpcValue& value) {
  YAML::Node list(YAML::NodeType::Sequence);
  for (int i = 0; i < value.size(); ++i) {
    Result<YAML::Node> entry = toYaml(value[i]);
    if (!entry) {
      return entry;
    }
    list.push_back(*entry);
  }
  return list;
}

Result<YAML::Node> mappingToYaml(XmlRpc::XmlRpcValue& value) {
  YAML::Node mapping(YAML::NodeType::Map);
  for (auto& [key, entry_value] : value) {
    Result<YAML::Node> entry = toYaml(entry_value);
    if (!entry) {
      return failure("'" + key + "': " + entry.error().message);
    }
    mapping[key] = *entry;
  }
  return mapping;
}

}  // namespace

Result<YAML::Node> toYaml(XmlRpc::XmlRpcValue& value) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(value) ? "true" : "false");
    case XmlRpc::XmlRpcValue::TypeInt:
      return YAML::Node(std::to_string(static_cast<int>(value)));
    case XmlRpc::XmlRpcValue::TypeDouble:
      return YAML::Node(allDigits(static_cast<double>(value)));
    case XmlRpc::XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    case XmlRpc::XmlRpcValue::TypeArray:
      return listToYaml(value);
    case XmlRpc::XmlRpcValue::TypeStruct:
      return mappingToYaml(value);
    default:
      return failure("is neither a number, a text, a list nor a mapping");
  }
}

Result<config::Section> readSection(const ros::NodeHandle& handle) {
  XmlRpc::XmlRpcValue value;
  if (!handle.getParam(handle.getNamespace(), value) ||
      value.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    return failure(handle.getNamespace() +
                   ": no parameters; load the node's file of config/ with rosparam or roslaunch");
  }
  const Result<YAML::Node> node = toYaml(value);
  if (!node) {
    return failure(handle.getNamespace() + ": parameter " + node.error().message);
  }
  return config::Section(*node, handle.getNamespace());
}

std::string nodeName() {
  const std::string& name = ros::this_node::getName();
  return name.substr(name.rfind('/') + 1);
}

}  // namespace otter_nav::ros_bridge
