// Near obstacles between messages and the core.
#pragma once

#include <otter_nav/NearObstacles.h>

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/tracker/near_obstacles.hpp"

namespace otter_nav::ros_bridge {

[[nodiscard]] NearObstacles toMessage(const tracker::NearObstacles& near, std::uint32_t id,
                                      const std::string& frame);

// An error names the frame, or x and y of different lengths. What is not finite the tracker
// refuses.
[[nodiscard]] Result<tracker::NearObstacles> toNearObstacles(const NearObstacles& message,
                                                             const std::string& frame);

}  // namespace otter_nav::ros_bridge
