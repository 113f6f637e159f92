#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <csignal>

#include "otter_nav/ros/parameters.hpp"
#include "recorder_node.hpp"

namespace {

volatile std::sig_atomic_t asked_to_end = 0;
void end(int /*signal*/) {
  asked_to_end = 1;
}

}  // namespace

// Not ROS's own handler: that one cuts the connections first, and what is on its way is lost.
int main(int argc, char** argv) {
  ros::init(argc, argv, "record", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, end);
  std::signal(SIGTERM, end);
  const ros::NodeHandle keep_alive;
  const auto node = otter_nav::ros_bridge::readSection(ros::NodeHandle("~"))
                        .and_then(otter_nav::nodes::RecorderNode::create);
  if (!node) {
    ROS_FATAL_STREAM(node.error().message);
    return 1;
  }
  constexpr double kLookS = 0.1;
  while (ros::ok() && asked_to_end == 0) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kLookS));
  }
  (*node)->finish();
  return (*node)->exitCode();
}
