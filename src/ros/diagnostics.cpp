#include "otter_nav/ros/diagnostics.hpp"

#include <ros/console.h>

#include <utility>

namespace otter_nav::ros_bridge {
namespace {

constexpr double kPeriodS = 1.0;
constexpr double kLogPeriodS = 5.0;

std::uint8_t toLevel(Diagnostics::Level level) {
  switch (level) {
    case Diagnostics::Level::kOk:
      return diagnostic_msgs::DiagnosticStatus::OK;
    case Diagnostics::Level::kWarning:
      return diagnostic_msgs::DiagnosticStatus::WARN;
    default:
      return diagnostic_msgs::DiagnosticStatus::ERROR;
  }
}

}  // namespace

Diagnostics::Diagnostics(ros::NodeHandle& node, ros::NodeHandle& private_node,
                         const std::string& hardware)
    : updater_(node, private_node) {
  updater_.setHardwareID(hardware);
  updater_.add("state", this, &Diagnostics::report);
  timer_ = node.createWallTimer(ros::WallDuration(kPeriodS),
                                [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void Diagnostics::setState(Level level, std::string message) {
  level_ = level;
  message_ = std::move(message);
}

void Diagnostics::setValue(const std::string& key, std::string value) {
  values_[key] = std::move(value);
}

void Diagnostics::refuse(const std::string& topic, const std::string& reason) {
  Refusals& refusals = refusals_[topic];
  ++refusals.count;
  refusals.last_reason = reason;
  const ros::WallTime now = ros::WallTime::now();
  if ((now - refusals.last_logged).toSec() > kLogPeriodS) {
    refusals.last_logged = now;
    ROS_WARN_STREAM("Refused a message of '" << topic << "': " << reason << " (" << refusals.count
                                             << " so far)");
  }
}

void Diagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.summary(toLevel(level_), message_);
  if (level_ == Level::kOk && !refusals_.empty()) {
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, "some messages were refused");
  }
  for (const auto& [key, value] : values_) {
    status.add(key, value);
  }
  for (const auto& [topic, refusals] : refusals_) {
    status.add("refused of " + topic,
               std::to_string(refusals.count) + " (" + refusals.last_reason + ")");
  }
}

}  // namespace otter_nav::ros_bridge
