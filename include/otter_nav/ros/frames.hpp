// The frames (REP-105; docs/frames.md) and what they are called here: parameters `frames/map`,
// `odom`, `base`, `lidar` of the nodes' namespace, or of one above it.
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"

namespace otter_nav::ros_bridge {

struct Frames {
  std::string map = "map";
  std::string odom = "odom";
  std::string base = "base_link";
  std::string lidar = "lidar";
};

// Those that are not set have the names above. An error names what is no frame, no name,
// or the name of two.
[[nodiscard]] Result<Frames> readFrames();

// As they were when the process first asked.
[[nodiscard]] const Frames& frames();
// An error says which frame it is and which it has to be.
[[nodiscard]] inline Status checkFrame(const std::string& frame, const std::string& expected) {
  return frame == expected ? Status()
                           : failure("frame_id is '" + frame + "', expected '" + expected + "'");
}
// The frame of a pose in `map` or `odom`.
[[nodiscard]] inline const std::string& odometryFrame(const std::string& which) {
  return which == "map" ? frames().map : frames().odom;
}

}  // namespace otter_nav::ros_bridge
