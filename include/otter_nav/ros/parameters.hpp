// Node parameters from the parameter server, read as strictly as a YAML file.
#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"

namespace otter_nav::ros_bridge {

// The same mapping, list or scalar; numbers keep all their digits.
[[nodiscard]] Result<YAML::Node> toYaml(XmlRpc::XmlRpcValue& value);

// All parameters below `handle`'s namespace; an error if there are none.
[[nodiscard]] Result<config::Section> readSection(const ros::NodeHandle& handle);

// This node's name without its namespace.
[[nodiscard]] std::string nodeName();

}  // namespace otter_nav::ros_bridge
