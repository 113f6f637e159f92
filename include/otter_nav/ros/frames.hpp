// The frames (REP-105; docs/frames.md) and what they are called here: parameters `frames/...` of
// the nodes' namespace, or of one above it (config/frames.yaml).
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/fields.hpp"

namespace otter_nav::ros_bridge {

struct Frames {
  std::string map = "map";
  std::string odom = "odom";
  std::string base = "base_link";
  std::string lidar = "lidar";

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("map", o.map, "fixed to the earth");
    fields("odom", o.odom, "the odometry's, which coincides with it");
    fields("base", o.base, "the vessel's");
    fields("lidar", o.lidar, "the scan's");
  }
};

// An error names the parameter that is missing, unknown or empty; the defaults if there are none.
[[nodiscard]] Result<Frames> readFrames();

// As they were when the process first asked.
[[nodiscard]] const Frames& frames();

// The frame of a pose in `map` or `odom`.
[[nodiscard]] inline const std::string& odometryFrame(const std::string& which) {
  return which == "map" ? frames().map : frames().odom;
}

}  // namespace otter_nav::ros_bridge
