// What the topics say of the mission, put together for people: the panel and the heads-up display
// show the same.
#pragma once

#include <geometry_msgs/Vector3Stamped.h>
#include <nav_msgs/Odometry.h>
#include <otter_nav/PlannerStatus.h>
#include <otter_nav/ThrusterCommand.h>
#include <otter_nav/TrackerStatus.h>
#include <ros/node_handle.h>

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::rviz_plugins {

// Values of the last minute by their messages' stamps. A stamp that jumps back (a bag begun again)
// starts a new minute.
class LastMinute {
 public:
  struct Sample {
    double time_s = 0.0;
    double value = 0.0;
  };
  static constexpr double kLengthS = 60.0;

  void add(double time_s, double value);
  [[nodiscard]] const std::deque<Sample>& samples() const { return samples_; }
  [[nodiscard]] double mean() const;  // 0 without samples
  [[nodiscard]] double max() const;

 private:
  std::deque<Sample> samples_;
  double sum_ = 0.0;
};

class Telemetry {
 public:
  // Topics are taken in the node's namespace.
  explicit Telemetry(const ros::NodeHandle& node);
  Telemetry(const Telemetry&) = delete;
  Telemetry& operator=(const Telemetry&) = delete;

  // Nothing for what was never heard.
  [[nodiscard]] const std::optional<PlannerStatus>& planner() const { return planner_; }
  [[nodiscard]] const std::optional<TrackerStatus>& tracker() const { return tracker_; }
  [[nodiscard]] const std::optional<nav_msgs::Odometry>& odometry() const { return odometry_; }
  [[nodiscard]] const std::optional<ThrusterCommand>& thrust() const { return thrust_; }
  [[nodiscard]] const std::optional<Eigen::Vector2d>& wind() const { return wind_; }  // m/s, ENU
  [[nodiscard]] const std::optional<Eigen::Vector2d>& current() const { return current_; }

  [[nodiscard]] const LastMinute& error() const { return error_; }  // of the tracker, m
  // Of the commands, those with a thruster at a limit; its mean is their share.
  [[nodiscard]] const LastMinute& saturated() const { return saturated_; }
  // Whether anything was heard within the last seconds of wall time.
  [[nodiscard]] bool alive() const;

  // The one that the tracker tells on `vessel`; without it the thrusters' limits are unknown.
  [[nodiscard]] const std::optional<vessel::Parameters>& vessel() const { return vessel_; }
  // A file or a name of config/vessels instead; empty: as above. False if there is no such vessel.
  bool setVessel(const std::string& name);

 private:
  void onThrust(const ThrusterCommand& message);
  void onVessel(const std::string& file);
  void heard() { heard_ = ros::WallTime::now(); }

  ros::NodeHandle node_;
  std::optional<PlannerStatus> planner_;
  std::optional<TrackerStatus> tracker_;
  std::optional<nav_msgs::Odometry> odometry_;
  std::optional<ThrusterCommand> thrust_;
  std::optional<Eigen::Vector2d> wind_;
  std::optional<Eigen::Vector2d> current_;
  LastMinute error_;
  LastMinute saturated_;
  std::optional<vessel::Parameters> vessel_;
  bool vessel_chosen_ = false;
  ros::WallTime heard_;
  ros::Subscriber vessel_subscriber_;
  std::vector<ros::Subscriber> subscribers_;
};

constexpr double kAtLimit = 0.995;  // of a thruster's limit counts as saturated
// Share of its limit that a thruster is asked for, in [-1, 1].
[[nodiscard]] double shareOfThrust(double thrust_n, const vessel::Thrusters& thrusters);

}  // namespace otter_nav::rviz_plugins
