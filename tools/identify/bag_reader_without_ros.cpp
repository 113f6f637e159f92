// Stands in for the bag reader where the core is built without ROS.
#include "identify/bag_reader.hpp"

namespace otter_nav::ros_bridge {

Result<identification::Recording> loadBag(const std::string& path,
                                          const std::string& /*odometry_topic*/,
                                          const std::string& /*command_topic*/) {
  return failure(path + ": this build has no ROS and reads no bags; give --csv");
}

}  // namespace otter_nav::ros_bridge
