// What plant_node is told: config/plant_node.yaml.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/vessel/scripted_vessel.hpp"

namespace otter_nav::nodes {

struct PlantNodeOptions {
  std::string vessel = "otter_gazebo";
  std::string disturbance = "paper";
  std::string scenario;
  int mission = 0;
  std::string world;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  int seed = 1;
  double control_period_s = 0.01;
  double speed = 1.0;
  bool lockstep = true;
  std::vector<std::string> lockstep_nodes = {"planner_node"};
  double lockstep_lag_s = 0.05;
  std::vector<vessel::ScriptedVessel> vessels;  // the scenario's

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("vessel", o.vessel, "a name of config/vessels, or a file");
    fields("disturbance", o.disturbance, "a preset of config/disturbances, or a file");
    fields("scenario", o.scenario, "file to take world and start from; empty: the two below");
    fields("mission", o.mission, {0.0, 1e6}, "of the scenario, counted from 0");
    fields("world", o.world, "map_server's YAML; empty: open water");
    fields.vector("start", o.start, {-1e6, 1e6}, "x m, y m, yaw rad; map frame, from east");
    fields("seed", o.seed, {0.0, 2147483647.0}, "of wind, waves and sensor noise");
    fields("control_period_s", o.control_period_s, {0.001, 0.1}, "between two commands");
    fields("speed", o.speed, {0.0, 1000.0}, "times real time; 0, in lockstep: as fast as it goes");
    fields("lockstep", o.lockstep, "time stands still until the control step's command has come");
    fields.texts("lockstep_nodes", o.lockstep_nodes, "have to acknowledge each scan as well");
    fields("lockstep_lag_s", o.lockstep_lag_s, {0.0, 1.0},
           "time may go on this far past a scan meanwhile");
  }
};

struct PlantNodeSetup {
  PlantNodeOptions node;
  plant::Options plant;
};
// Fills world, start and other vessels from the scenario if there is one.
[[nodiscard]] Result<PlantNodeSetup> readPlantNodeSetup(config::Section section);

}  // namespace otter_nav::nodes
