// Nodes in any order: one that came up on the computer's clock goes over to the simulated one when
// that appears (/use_sim_time true and somebody publishes /clock), which ROS itself only looks for
// when a process starts.
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <rosgraph_msgs/Clock.h>

#include <atomic>
#include <memory>

namespace otter_nav::ros_bridge {

class ClockWatch {
 public:
  ClockWatch();
  // True once, after the clock has become another: what was built on the old one is void.
  [[nodiscard]] bool changed() { return changed_.exchange(false); }

 private:
  void onClock(const rosgraph_msgs::Clock& message);

  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  ros::Subscriber subscriber_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
  std::atomic<bool> changed_{false};
  bool taken_ = false;
  bool told_ = false;
};

}  // namespace otter_nav::ros_bridge
