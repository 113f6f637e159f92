// What config/tracker_node.yaml sets.
#pragma once

#include <string>

#include "otter_nav/config/fields.hpp"

namespace otter_nav::nodes {

struct TrackerNodeOptions {
  std::string vessel = "otter_gazebo";
  std::string odometry_frame = "odom";  // both coincide (docs/frames.md)
  bool lockstep = true;
  double speed = 1.0;
  bool recorded = false;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("vessel", o.vessel, "a name of vessels/, or a file");
    fields.choice("odometry_frame", o.odometry_frame,
                  config::Choices<std::string>{{"odom", "odom"}, {"map", "map"}},
                  "odom or map, which coincide");
    fields("lockstep", o.lockstep,
           "each odometry is one control step; false: a loop with a clock of its own");
    fields("speed", o.speed, {0.0, 1000.0},
           "simulated over real time; 0 (in lockstep only): unknown");
    fields("recorded", o.recorded, "begin when a recorder listens, so that it has the first step");
  }
};

}  // namespace otter_nav::nodes
