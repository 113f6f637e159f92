#include "plant_node_options.hpp"

#include "otter_nav/config/share.hpp"
#include "otter_nav/scenario/scenario.hpp"

namespace otter_nav::nodes {
namespace {

constexpr double kMaxSpeed = 1000.0;

Result<PlantNodeOptions> readNodeOptions(config::Section& section) {
  PlantNodeOptions options;
  std::vector<double> start = {0.0, 0.0, 0.0};
  section.read("vessel", options.vessel);
  section.read("disturbance", options.disturbance);
  section.read("scenario", options.scenario);
  section.read("mission", options.mission, {0.0, 1e6});
  section.read("world", options.world);
  section.read("start", start, 3, {-1e6, 1e6});
  section.read("seed", options.seed, {0.0, 2147483647.0});
  section.read("control_period_s", options.control_period_s, {0.001, 0.1});
  section.read("speed", options.speed, {0.0, kMaxSpeed});
  section.read("lockstep", options.lockstep);
  section.read("lockstep_nodes", options.lockstep_nodes);
  section.read("lockstep_lag_s", options.lockstep_lag_s, {0.0, 1.0});
  section.read("lockstep_timeout_s", options.lockstep_timeout_s, {1.0, 3600.0});
  options.start = {{start[0], start[1]}, start[2]};
  if (!options.lockstep && options.speed <= 0.0) {
    return failure(section.where() +
                   ": parameter 'speed' = 0 is outside its allowed range (0, 1000] when 'lockstep' "
                   "is false");
  }
  return options;
}

Status takeScenario(PlantNodeOptions& options) {
  const Result<scenario::Scenario> scenario = scenario::loadScenario(options.scenario);
  if (!scenario) {
    return failure(scenario.error().message);
  }
  const Result<scenario::Mission> mission = scenario::missionOf(*scenario, options.mission);
  if (!mission) {
    return failure(mission.error().message);
  }
  options.world = scenario->world_path;
  options.start = {mission->start.position, mission->start.psi_rad};
  return {};
}

}  // namespace

Result<PlantNodeSetup> readPlantNodeSetup(config::Section section) {
  Result<PlantNodeOptions> node = readNodeOptions(section);
  Result<plant::Options> plant = config::read<plant::Options>(section.child("plant"));
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  if (!node) {
    return failure(node.error().message);
  }
  if (!plant) {
    return failure(plant.error().message);
  }
  if (node->lockstep && plant->odometry.latency_s > 0.0) {
    return failure(section.where() +
                   ": parameter 'plant/odometry/latency_s' has to be 0 in lockstep, where a step's "
                   "odometry asks for the step's command");
  }
  if (!node->scenario.empty()) {
    if (const Status status = takeScenario(*node); !status) {
      return failure(status.error().message);
    }
  }
  const Result<std::string> preset =
      config::findFile(node->disturbance.find('/') == std::string::npos
                           ? "config/disturbances/" + node->disturbance + ".yaml"
                           : node->disturbance);
  if (!preset) {
    return failure(section.where() + ": parameter 'disturbance': " + preset.error().message);
  }
  Result<plant::EnvironmentOptions> disturbance = plant::loadDisturbance(*preset);
  if (!disturbance) {
    return failure(disturbance.error().message);
  }
  Result<vessel::Parameters> vessel =
      config::vesselFile(node->vessel).and_then(vessel::loadParameters);
  if (!vessel) {
    return failure(section.where() + ": parameter 'vessel': " + vessel.error().message);
  }
  plant->vessel = *std::move(vessel);
  plant->disturbance = *disturbance;
  return PlantNodeSetup{*node, *plant};
}

}  // namespace otter_nav::nodes
