#include "telemetry.hpp"

#include <ros/package.h>
#include <std_msgs/String.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>

#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::rviz_plugins {
namespace {

constexpr double kAliveS = 3.0;

// rviz is no program of this package, beside which its files would be found.
Result<vessel::Parameters> load(const std::string& name) {
  const std::string shipped =
      ros::package::getPath("otter_nav") + "/config/vessels/" + name + ".yaml";
  auto vessel = vessel::loadParameters(shipped);
  return vessel ? vessel : vessel::loadParameters(name);
}

}  // namespace

void LastMinute::add(double time_s, double value) {
  if (!samples_.empty() && time_s < samples_.back().time_s) {
    samples_.clear();
    sum_ = 0.0;
  }
  samples_.push_back({time_s, value});
  sum_ += value;
  while (samples_.front().time_s < time_s - kLengthS) {
    sum_ -= samples_.front().value;
    samples_.pop_front();
  }
}

double LastMinute::mean() const {
  return samples_.empty() ? 0.0 : sum_ / static_cast<double>(samples_.size());
}

double LastMinute::max() const {
  double most = 0.0;
  for (const Sample& sample : samples_) {
    most = std::max(most, sample.value);
  }
  return most;
}

double shareOfThrust(double thrust_n, const vessel::Thrusters& thrusters) {
  const double given_n = std::clamp(thrust_n, -thrusters.astern_max_n, thrusters.ahead_max_n);
  return std::copysign(vessel::shareOfLimit(given_n, thrusters), given_n);
}

Telemetry::Telemetry(const ros::NodeHandle& node) : node_(node) {
  subscribers_.push_back(node_.subscribe<PlannerStatus>(
      "planner_status", 10, [this](const PlannerStatusConstPtr& message) {
        planner_ = *message;
        heard();
      }));
  subscribers_.push_back(node_.subscribe<TrackerStatus>(
      "tracker_status", 10, [this](const TrackerStatusConstPtr& message) {
        tracker_ = *message;
        if (std::isfinite(message->position_error)) {
          error_.add(message->header.stamp.toSec(), message->position_error);
        }
        heard();
      }));
  subscribers_.push_back(
      node_.subscribe<nav_msgs::Odometry>("odom", 10, [this](const nav_msgs::OdometryConstPtr& m) {
        odometry_ = *m;
        heard();
      }));
  subscribers_.push_back(node_.subscribe<ThrusterCommand>(
      "thruster_command", 100,
      [this](const ThrusterCommandConstPtr& message) { onThrust(*message); }));
  const auto keep = [this](const std::string& topic, std::optional<Eigen::Vector2d>& into) {
    subscribers_.push_back(node_.subscribe<geometry_msgs::Vector3Stamped>(
        topic, 10, [&into](const geometry_msgs::Vector3StampedConstPtr& message) {
          into = Eigen::Vector2d(message->vector.x, message->vector.y);
        }));
  };
  keep("wind", wind_);
  keep("current", current_);
  setVessel("");
}

void Telemetry::onThrust(const ThrusterCommand& message) {
  thrust_ = message;
  if (vessel_) {
    const bool at_limit =
        vessel::shareOfLimit({message.left, message.right}, vessel_->thrusters) >= kAtLimit;
    saturated_.add(message.header.stamp.toSec(), at_limit ? 1.0 : 0.0);
  }
  heard();
}

bool Telemetry::alive() const {
  return !heard_.isZero() && (ros::WallTime::now() - heard_).toSec() < kAliveS;
}

void Telemetry::onVessel(const std::string& file) {
  if (vessel_chosen_) {
    return;
  }
  try {
    const auto vessel = vessel::readParameters({YAML::Load(file), "vessel"});
    if (vessel) {
      vessel_ = *vessel;
    }
  } catch (const YAML::Exception&) {
    vessel_.reset();
  }
}

bool Telemetry::setVessel(const std::string& name) {
  vessel_.reset();
  vessel_chosen_ = !name.empty();
  if (!vessel_chosen_) {
    // The topic is latched: a new subscription hears it again.
    vessel_subscriber_ = node_.subscribe<std_msgs::String>(
        "vessel", 1, [this](const std_msgs::StringConstPtr& message) { onVessel(message->data); });
    return true;
  }
  const auto vessel = load(name);
  if (vessel) {
    vessel_ = *vessel;
  }
  return vessel.has_value();
}

}  // namespace otter_nav::rviz_plugins
