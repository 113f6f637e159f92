#include "otter_nav/ros/live_parameters.hpp"

#include <std_msgs/String.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "otter_nav/base/text.hpp"
#include "otter_nav/ros/parameters.hpp"

namespace otter_nav::ros_bridge {
namespace {

using XmlRpc::XmlRpcValue;

constexpr double kPollS = 1.0;

std::vector<std::string> partsOf(const std::string& path) {
  std::vector<std::string> parts;
  std::istringstream in(path);
  for (std::string part; std::getline(in, part, '/');) {
    parts.push_back(part);
  }
  return parts;
}

bool isIndex(const std::string& part) {
  return part.find_first_not_of("0123456789") == std::string::npos;
}

// The last key, and the index in a list.
std::string nameOf(const std::string& path) {
  const std::vector<std::string> parts = partsOf(path);
  return isIndex(parts.back()) ? parts[parts.size() - 2] + '_' + parts.back() : parts.back();
}

// Of a list of `size`; nothing where it has no such one.
std::optional<int> indexIn(const std::string& part, int size) {
  int index = 0;
  const char* end = part.data() + part.size();
  const auto [read, error] = std::from_chars(part.data(), end, index);
  const bool is_one = error == std::errc() && read == end && index >= 0 && index < size;
  return is_one ? std::optional<int>(index) : std::nullopt;
}

// Null where there is none.
XmlRpcValue* find(XmlRpcValue& tree, const std::string& path) {
  XmlRpcValue* at = &tree;
  for (const std::string& part : partsOf(path)) {
    if (at->getType() == XmlRpcValue::TypeStruct && at->hasMember(part)) {
      at = &(*at)[part];
      continue;
    }
    const bool is_list = at->getType() == XmlRpcValue::TypeArray;
    const std::optional<int> index = is_list ? indexIn(part, at->size()) : std::nullopt;
    if (!index) {
      return nullptr;
    }
    at = &(*at)[*index];
  }
  return at;
}

bool isNumber(const XmlRpcValue& value) {
  return value.getType() == XmlRpcValue::TypeDouble || value.getType() == XmlRpcValue::TypeInt;
}

double numberOf(XmlRpcValue& value) {
  return value.getType() == XmlRpcValue::TypeInt ? static_cast<int>(value)
                                                 : static_cast<double>(value);
}

bool same(XmlRpcValue& a, XmlRpcValue& b) {
  return isNumber(a) && isNumber(b) ? numberOf(a) == numberOf(b) : a == b;
}

void leaves(XmlRpcValue& tree, const std::string& path, std::map<std::string, XmlRpcValue>& all) {
  if (tree.getType() == XmlRpcValue::TypeStruct) {
    for (auto& [key, value] : tree) {
      leaves(value, path.empty() ? key : path + '/' + key, all);
    }
  } else if (tree.getType() == XmlRpcValue::TypeArray) {
    for (int i = 0; i < tree.size(); ++i) {
      leaves(tree[i], path + '/' + std::to_string(i), all);
    }
  } else {
    all[path] = tree;
  }
}

}  // namespace

LiveParameters::LiveParameters(std::vector<config::NumberField> live, Apply apply,
                               const ros::Publisher& in_force)
    : live_(std::move(live)), apply_(std::move(apply)), told_(in_force) {
  node_.getParam(node_.getNamespace(), in_force_);
  seen_ = in_force_;
  tell();
  if (!live_.empty()) {
    advertise();
  }
  timer_ = node_.createWallTimer(ros::WallDuration(kPollS),
                                 [this](const ros::WallTimerEvent&) { poll(); });
}

void LiveParameters::advertise() {
  dynamic_reconfigure::ConfigDescription description;
  dynamic_reconfigure::Group group;
  group.name = "Default";
  for (const config::NumberField& field : live_) {
    dynamic_reconfigure::ParamDescription parameter;
    parameter.name = nameOf(field.path);
    parameter.type = "double";
    parameter.description = field.effect;
    group.parameters.push_back(parameter);
    const auto add = [&](dynamic_reconfigure::Config& config, double value) {
      dynamic_reconfigure::DoubleParameter number;
      number.name = parameter.name;
      number.value = value;
      config.doubles.push_back(number);
    };
    add(description.min, field.range.min);
    add(description.max, field.range.max);
    add(description.dflt, field.value);
  }
  description.groups.push_back(group);
  for (dynamic_reconfigure::Config* config :
       {&description.min, &description.max, &description.dflt}) {
    config->groups.resize(1);
    config->groups[0].name = group.name;
    config->groups[0].state = 1;
  }
  description_publisher_ =
      node_.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  update_publisher_ = node_.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true);
  description_publisher_.publish(description);
  update_publisher_.publish(values());
  service_ = node_.advertiseService("set_parameters", &LiveParameters::onRequest, this);
}

dynamic_reconfigure::Config LiveParameters::values() const {
  dynamic_reconfigure::Config config;
  XmlRpcValue tree = in_force_;
  for (const config::NumberField& field : live_) {
    XmlRpcValue* value = find(tree, field.path);
    dynamic_reconfigure::DoubleParameter number;
    number.name = nameOf(field.path);
    number.value = value != nullptr && isNumber(*value) ? numberOf(*value) : field.value;
    config.doubles.push_back(number);
  }
  config.groups.resize(1);
  config.groups[0].name = "Default";
  config.groups[0].state = 1;
  return config;
}

bool LiveParameters::onRequest(dynamic_reconfigure::ReconfigureRequest& request,
                               dynamic_reconfigure::ReconfigureResponse& response) {
  std::vector<Change> changes;
  const auto take = [&](const std::string& name, double value) {
    const auto field = std::find_if(live_.begin(), live_.end(),
                                    [&](const auto& one) { return nameOf(one.path) == name; });
    if (field != live_.end()) {
      changes.push_back({field->path, value});
    } else {
      warnOf(name);
    }
  };
  for (const dynamic_reconfigure::DoubleParameter& number : request.config.doubles) {
    take(number.name, number.value);
  }
  for (const dynamic_reconfigure::IntParameter& number : request.config.ints) {
    take(number.name, number.value);
  }
  change(changes);
  response.config = values();
  return true;
}

void LiveParameters::poll() {
  XmlRpcValue now;
  if (!node_.getParam(node_.getNamespace(), now)) {
    return;
  }
  std::map<std::string, XmlRpcValue> all;
  leaves(now, "", all);
  std::vector<Change> changes;
  for (auto& [path, value] : all) {
    XmlRpcValue* before = find(seen_, path);
    if (before == nullptr) {
      warnOfUnknown(path);
      continue;
    }
    const bool is_live = std::any_of(live_.begin(), live_.end(),
                                     [&key = path](const auto& one) { return one.path == key; });
    XmlRpcValue* in_force = find(in_force_, path);
    if (is_live && isNumber(value)) {
      if (in_force == nullptr || !same(*in_force, value)) {
        changes.push_back({path, numberOf(value)});
      }
    } else if (!same(*before, value)) {
      warnOf(path);
    }
    *before = value;
  }
  change(changes);
}

void LiveParameters::change(const std::vector<Change>& changes) {
  XmlRpcValue wanted = in_force_;
  std::string told;
  for (const Change& one : changes) {
    XmlRpcValue* value = find(wanted, one.path);
    if (value == nullptr || (isNumber(*value) && numberOf(*value) == one.value)) {
      continue;
    }
    *value = XmlRpcValue(one.value);
    told += (told.empty() ? "" : ", ") + one.path + text(": %g", one.value);
  }
  if (told.empty()) {
    return;
  }
  const Status status = toYaml(wanted).and_then(
      [&](const YAML::Node& node) { return apply_(config::Section(node, node_.getNamespace())); });
  if (status) {
    in_force_ = wanted;
    tell();
    ROS_INFO_STREAM("Changed while running: " << told);
  } else {
    ROS_WARN_STREAM("Not changed (" << told << "): " << status.error().message);
  }
  // The server shows what is in force.
  for (const Change& one : changes) {
    std::vector<std::string> parts = partsOf(one.path);
    std::string path = one.path;
    if (isIndex(parts.back())) {
      path.resize(path.rfind('/'));
    }
    if (XmlRpcValue* value = find(in_force_, path)) {
      node_.setParam(path, *value);
    }
  }
  update_publisher_.publish(values());
}

void LiveParameters::tell() {
  std_msgs::String text;
  if (const Result<YAML::Node> node = toYaml(in_force_)) {
    text.data = YAML::Dump(*node) + '\n';
  }
  told_.publish(text);
}

void LiveParameters::warnOf(const std::string& path) const {
  std::string names;
  for (const config::NumberField& field : live_) {
    names += (names.empty() ? "" : ", ") + nameOf(field.path);
  }
  ROS_WARN_STREAM(
      "Parameter '" << path << "' was set: that has no effect while the node runs, only "
                    << "when it starts."
                    << (names.empty() ? std::string() : " What can be changed now: " + names));
}

void LiveParameters::warnOfUnknown(const std::string& path) {
  if (!unknown_.insert(path).second) {
    return;
  }
  const auto meant = std::find_if(live_.begin(), live_.end(), [&](const auto& one) {
    return nameOf(one.path) == nameOf(path);
  });
  ROS_WARN_STREAM(
      "Parameter '" << path << "' was set: this node has none of that name, and it has no "
                    << "effect."
                    << (meant == live_.end() ? std::string() : " Meant: '" + meant->path + "'?"));
}

}  // namespace otter_nav::ros_bridge
