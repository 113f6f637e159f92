#include "otter_nav/ros/diagnostics.hpp"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "otter_nav/base/text.hpp"

namespace otter_nav::ros_bridge {
namespace {

constexpr double kPeriodS = 1.0;
constexpr double kLogPeriodS = 5.0;
constexpr double kRefusalsCountS = 10.0;

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

void Diagnostics::setValue(const std::string& key, double value) {
  values_[key] = text("%.4g", value);
}

void Diagnostics::received(const std::string& topic) {
  Stream& stream = streams_[topic];
  ++stream.count;
  stream.last = ros::WallTime::now();
}

double Diagnostics::silence(const std::string& topic) const {
  const auto stream = streams_.find(topic);
  return (ros::WallTime::now() - (stream != streams_.end() ? stream->second.last : started_))
      .toSec();
}

void Diagnostics::refuse(const std::string& topic, const std::string& reason) {
  Refusals& refusals = refusals_[topic];
  ++refusals.count;
  refusals.last_reason = reason;
  const ros::WallTime now = ros::WallTime::now();
  refusals.last = now;
  if ((now - refusals.last_logged).toSec() > kLogPeriodS) {
    refusals.last_logged = now;
    ROS_WARN_STREAM("Refused a message of '" << topic << "': " << reason << " (" << refusals.count
                                             << " so far)");
  }
}

void Diagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.summary(toLevel(level_), message_);
  const ros::WallTime now = ros::WallTime::now();
  const bool refuses = std::any_of(refusals_.begin(), refusals_.end(), [&](const auto& one) {
    return (now - one.second.last).toSec() < kRefusalsCountS;
  });
  if (level_ == Level::kOk && refuses) {
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, "some messages were refused");
  }
  for (const auto& [key, value] : values_) {
    status.add(key, value);
  }
  const double since_s = std::max(1e-3, (now - reported_).toSec());
  reported_ = now;
  for (auto& [topic, stream] : streams_) {
    status.addf("rate of " + topic + ", Hz", "%.1f", static_cast<double>(stream.count) / since_s);
    status.addf("age of " + topic + ", s", "%.3f", (now - stream.last).toSec());
    stream.count = 0;
  }
  for (const auto& [topic, refusals] : refusals_) {
    status.add("refused of " + topic,
               std::to_string(refusals.count) + " (" + refusals.last_reason + ")");
  }
}

}  // namespace otter_nav::ros_bridge
