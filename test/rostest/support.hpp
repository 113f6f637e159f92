// What the tests of the nodes share: waiting for messages, and messages to send.
#pragma once

#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <deque>
#include <string>

#include "otter_nav/ros/call_service.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"

namespace otter_nav::rostest {

constexpr double kPatienceS = 30.0;  // of wall time; enough on a busy machine

// Spins until `done` or the patience ends; whether it was done.
template <typename Done>
bool waitUntil(const Done& done, double patience_s = kPatienceS) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(patience_s);
  while (ros::ok() && ros::WallTime::now() < end) {
    ros::spinOnce();
    if (done()) {
      return true;
    }
    ros::WallDuration(0.002).sleep();
  }
  return false;
}

// Keeps what comes on a topic.
template <typename Message>
class Inbox {
 public:
  Inbox(ros::NodeHandle& node, const std::string& topic) {
    subscriber_ = node.subscribe<Message>(
        topic, 1000,
        [this](const boost::shared_ptr<const Message>& message) { messages.push_back(*message); });
  }
  // Waits for a message that fulfils `wanted`, from those here on.
  template <typename Wanted>
  bool waitFor(const Wanted& wanted, double patience_s = kPatienceS) {
    std::size_t next = 0;
    return waitUntil(
        [&] {
          for (; next < messages.size(); ++next) {
            if (wanted(messages[next])) {
              return true;
            }
          }
          return false;
        },
        patience_s);
  }
  bool connected() {
    return waitUntil([this] { return subscriber_.getNumPublishers() > 0; });
  }
  void close() { subscriber_.shutdown(); }

  std::deque<Message> messages;

 private:
  ros::Subscriber subscriber_;
};

inline nav_msgs::Odometry odometryAt(const Eigen::Vector2d& position, double psi_rad,
                                     const ros::Time& stamp) {
  nav_msgs::Odometry message;
  message.header.frame_id = ros_bridge::frames().odom;
  message.header.stamp = stamp;
  message.child_frame_id = ros_bridge::frames().base;
  message.pose.pose = ros_bridge::toPose({position, psi_rad});
  return message;
}

}  // namespace otter_nav::rostest

// The main of a test that is a node.
#define OTTER_NAV_ROSTEST_MAIN(name)      \
  int main(int argc, char** argv) {       \
    testing::InitGoogleTest(&argc, argv); \
    ros::init(argc, argv, name);          \
    const ros::NodeHandle keep_alive;     \
    return RUN_ALL_TESTS();               \
  }
