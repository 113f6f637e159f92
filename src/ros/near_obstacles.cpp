#include "otter_nav/ros/near_obstacles.hpp"

#include <cstddef>
#include <string>

#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"

namespace otter_nav::ros_bridge {

NearObstacles toMessage(const tracker::NearObstacles& near, std::uint32_t id,
                        const std::string& frame) {
  NearObstacles message;
  message.header.frame_id = frame;
  message.header.stamp = toRosTime(near.start_s);
  message.id = id;
  for (const Eigen::Vector2d& point : near.points) {
    message.x.push_back(point.x());
    message.y.push_back(point.y());
  }
  return message;
}

Result<tracker::NearObstacles> toNearObstacles(const NearObstacles& message,
                                               const std::string& frame) {
  if (const Status status = checkFrame(message.header.frame_id, frame); !status) {
    return failure(status.error().message);
  }
  if (message.x.size() != message.y.size()) {
    return failure("near obstacles: x and y hold " + std::to_string(message.x.size()) + " and " +
                   std::to_string(message.y.size()));
  }
  tracker::NearObstacles near;
  near.start_s = message.header.stamp.toSec();
  near.points.reserve(message.x.size());
  for (std::size_t i = 0; i < message.x.size(); ++i) {
    near.points.emplace_back(message.x[i], message.y[i]);
  }
  return near;
}

}  // namespace otter_nav::ros_bridge
