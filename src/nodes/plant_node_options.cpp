#include "plant_node_options.hpp"

#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/scenario/scenario.hpp"

namespace otter_nav::nodes {
namespace {

Status takeScenario(PlantNodeOptions& options) {
  const auto scenario = scenario::loadScenario(options.scenario);
  const auto mission = scenario.and_then(
      [&](const scenario::Scenario& all) { return scenario::missionOf(all, options.mission); });
  if (!mission) {
    return failure(mission.error().message);
  }
  options.world = scenario->world_path;
  options.start << mission->start.position, mission->start.psi_rad;
  options.vessels = scenario->vessels;
  return {};
}

}  // namespace

Result<PlantNodeSetup> readPlantNodeSetup(config::Section section) {
  PlantNodeSetup setup;
  PlantNodeOptions& node = setup.node;
  const Status fields = config::readFields(section, node);
  Result<plant::Options> plant = plant::readOptions(section.child("plant"));
  if (const Status status = firstFailure(section.finish(), fields, plant); !status) {
    return failure(status.error().message);
  }
  if (!node.lockstep && node.speed <= 0.0) {
    return failure(section.where() +
                   ": parameter 'speed' = 0 is outside its allowed range (0, 1000] when 'lockstep' "
                   "is false");
  }
  if (node.lockstep && plant->odometry.latency_s > 0.0) {
    return failure(section.where() +
                   ": parameter 'plant/odometry/latency_s' has to be 0 in lockstep, where a step's "
                   "odometry asks for the step's command");
  }
  if (!node.scenario.empty()) {
    if (const Status status = takeScenario(node); !status) {
      return failure(status.error().message);
    }
  }
  const auto disturbance = plant::loadDisturbance(node.disturbance);
  auto vessel = vessel::loadParameters(node.vessel);
  if (const Status status = firstFailure(disturbance, vessel); !status) {
    return failure(status.error().message);
  }
  plant->vessel = *std::move(vessel);
  plant->disturbance = *disturbance;
  setup.plant = *std::move(plant);
  return setup;
}

}  // namespace otter_nav::nodes
