// Recordings from rosbag files. The signature knows no ROS, so that `identify` is one program with
// and without it.
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/identification/data_set.hpp"

namespace otter_nav::ros_bridge {

// Reads nav_msgs/Odometry and otter_nav/ThrusterCommand from the two topics, with or without their
// leading slash. Stamps are the headers' (the receive time where a header has none). An error names
// the file, the topic missing or of another type, or the message that is no pose.
[[nodiscard]] Result<identification::Recording> loadBag(const std::string& path,
                                                        const std::string& odometry_topic,
                                                        const std::string& command_topic);

}  // namespace otter_nav::ros_bridge
