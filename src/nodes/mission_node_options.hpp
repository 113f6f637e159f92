// What mission_node is told: config/mission_node.yaml.
#pragma once

#include <string>

namespace otter_nav::nodes {

struct MissionNodeOptions {
  std::string scenario;
  int mission = 0;
  std::string vessel = "otter_gazebo";
  std::string disturbance = "paper";
  int seed = 1;
  std::string result;
  double timeout_s = 900.0;
  bool recorded = false;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("scenario", o.scenario, "file");
    fields("mission", o.mission, {0.0, 1e6}, "counted from 0");
    fields("vessel", o.vessel, "labels the result; tells the reference's states");
    fields("disturbance", o.disturbance, "labels the result");
    fields("seed", o.seed, {0.0, 2147483647.0}, "labels the result");
    fields("result", o.result, "JSON file, with the track beside it as CSV; empty: none");
    fields("timeout_s", o.timeout_s, {1.0, 1e6}, "of simulated time, then the mission is over");
    fields("recorded", o.recorded, "send the goal when a recorder listens");
  }
};

}  // namespace otter_nav::nodes
