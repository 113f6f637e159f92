// A node's health on /diagnostics: its state, a few values, and which messages it refused and why.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <map>
#include <string>

namespace otter_nav::ros_bridge {

// Used from one thread. Published about once a second of ROS time.
class Diagnostics {
 public:
  enum class Level { kOk, kWarning, kError };

  Diagnostics(ros::NodeHandle& node, ros::NodeHandle& private_node, const std::string& hardware);

  void setState(Level level, std::string message);
  void setValue(const std::string& key, std::string value);
  void setValue(const std::string& key, double value);
  // Counts a message of `topic`: its rate and the last one's age, of wall time, are told.
  void received(const std::string& topic);
  // Wall time since the last message of `topic`, or since the start, s.
  [[nodiscard]] double silence(const std::string& topic) const;
  // Counts a refused message of `topic`, and logs the first and then at most one each 5 s. A node
  // that is well otherwise warns for 10 s.
  void refuse(const std::string& topic, const std::string& reason);

 private:
  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

  struct Refusals {
    std::uint64_t count = 0;
    std::string last_reason;
    ros::WallTime last;
    ros::WallTime last_logged;
  };
  struct Stream {
    std::uint64_t count = 0;
    ros::WallTime last;
  };
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
  Level level_ = Level::kOk;
  std::string message_ = "starting";
  std::map<std::string, std::string> values_;
  std::map<std::string, Stream> streams_;
  ros::WallTime started_ = ros::WallTime::now();
  ros::WallTime reported_ = started_;
  std::map<std::string, Refusals> refusals_;
};

}  // namespace otter_nav::ros_bridge
