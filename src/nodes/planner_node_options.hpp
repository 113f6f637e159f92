// What config/planner_node.yaml sets.
#pragma once

#include <string>

#include "map_options.hpp"
#include "otter_nav/config/fields.hpp"

namespace otter_nav::nodes {

struct PlannerNodeOptions {
  std::string vessel = "otter_gazebo";
  std::string odometry_frame = "odom";  // both coincide (docs/frames.md)
  int seed = 1;
  bool lockstep = true;
  double lockstep_lag_s = 0.05;
  int lockstep_iterations = 1200;
  double planning_budget_s = 0.1;
  bool use_topology_node = true;
  DistanceFieldSettings distance_field;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("vessel", o.vessel, "a name of vessels/, or a file");
    fields.choice("odometry_frame", o.odometry_frame,
                  config::Choices<std::string>{{"odom", "odom"}, {"map", "map"}},
                  "odom or map, which coincide");
    fields("seed", o.seed, {0, 2147483647}, "of the plans");
    fields("lockstep", o.lockstep, "one decision for each map update, which is then acknowledged");
    fields("lockstep_lag_s", o.lockstep_lag_s, {0.0, 1.0},
           "decisions take effect this long after the scan (the plant's figure)");
    fields("lockstep_iterations", o.lockstep_iterations, {1, 1e7},
           "bound a plan in lockstep, so that it is the same every time");
    // Five times the most is still answered within the 5 s for which the mission waits.
    fields("planning_budget_s", o.planning_budget_s, {0.001, 0.9},
           "of wall time, bounds a plan otherwise; five times as much where the vessel may creep");
    fields("use_topology_node", o.use_topology_node,
           "ask its service for guide paths; else the planner finds its own");
    fields.group("distance_field", o.distance_field, "");
  }
};

}  // namespace otter_nav::nodes
