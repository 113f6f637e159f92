#include "otter_nav/ros/clock_watch.hpp"

#include <ros/console.h>
#include <ros/param.h>

namespace otter_nav::ros_bridge {

ClockWatch::ClockWatch() {
  if (ros::Time::isSimTime()) {
    return;
  }
  node_.setCallbackQueue(&queue_);
  subscriber_ = node_.subscribe("/clock", 100, &ClockWatch::onClock, this,
                                ros::TransportHints().tcpNoDelay());
  spinner_ = std::make_unique<ros::AsyncSpinner>(1, &queue_);
  spinner_->start();
}

void ClockWatch::onClock(const rosgraph_msgs::Clock& message) {
  if (!taken_) {
    bool simulated = false;
    ros::param::get("/use_sim_time", simulated);
    if (!simulated) {
      if (!told_) {
        ROS_WARN(
            "Somebody publishes /clock, but /use_sim_time is not true: this node stays on the "
            "computer's clock");
      }
      told_ = true;
      return;
    }
    taken_ = true;
    ROS_INFO("/clock has come up (use_sim_time): this node goes over to it and starts anew");
    changed_ = true;
  }
  ros::Time::setNow(message.clock);
}

}  // namespace otter_nav::ros_bridge
