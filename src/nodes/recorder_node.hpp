// recorder_node: writes topics to a bag. In lockstep time waits for it, so nothing is lost at any
// speed; what is lost without is an error that says what. The bag is closed and indexed however the
// run ends. Parameters: launch/record.launch.
#pragma once

#include <ros/node_handle.h>
#include <std_msgs/Header.h>

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "otter_nav/config/section.hpp"
#include "recorder_node_options.hpp"
#include "recording.hpp"

namespace otter_nav::nodes {

class RecorderNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<RecorderNode>> create(config::Section section);
  ~RecorderNode();
  RecorderNode(const RecorderNode&) = delete;
  RecorderNode& operator=(const RecorderNode&) = delete;
  // 0 if the bag is closed and nothing was lost.
  [[nodiscard]] int exitCode() const { return failed_ ? 1 : 0; }
  // Takes what is still on its way, and closes the bag.
  void finish();

 private:
  explicit RecorderNode(RecorderNodeOptions options);

  [[nodiscard]] Status open() { return recording_.open(options_.file); }
  void listen();
  void onMessage(const std::string& topic, const Recording::Event& event);
  void take(const std::string& topic, const Recording::Event& event);
  // Says that it listens, once everything paced has come.
  void announce();
  // In lockstep: time may go on past the scans up to which everything is here.
  void acknowledge();

  RecorderNodeOptions options_;
  ros::NodeHandle node_;
  Recording recording_;
  std::map<std::string, ros::Time> paced_;  // last stamps, of what has come
  std::deque<ros::Time> scans_;             // not acknowledged yet
  ros::Publisher recording_publisher_;
  ros::Publisher acknowledgement_;
  std::vector<ros::Subscriber> subscribers_;
  bool announced_ = false;
  bool finished_ = false;
  bool failed_ = false;
};

}  // namespace otter_nav::nodes
