#include "map_options.hpp"
#include "otter_nav/config/share.hpp"
#include "otter_nav/ros/frames.hpp"
#include "planner_node.hpp"

namespace otter_nav::nodes {
namespace {

PlannerNodeOptions readNodeOptions(config::Section& section) {
  PlannerNodeOptions options;
  section.read("vessel", options.vessel);
  section.read("odometry_frame", options.odometry_frame,
               std::vector<std::string>{ros_bridge::kOdomFrame, ros_bridge::kMapFrame});
  section.read("seed", options.seed, {0.0, 2147483647.0});
  section.read("lockstep", options.lockstep);
  section.read("lockstep_lag_s", options.lockstep_lag_s, {0.0, 1.0});
  section.read("lockstep_iterations", options.lockstep_iterations, {1.0, 1e7});
  section.read("planning_budget_s", options.planning_budget_s, {0.001, 60.0});
  section.read("decision_rate_hz", options.decision_rate_hz, {1.0, 200.0});
  section.read("input_timeout_s", options.input_timeout_s, {0.1, 3600.0});
  section.read("use_topology_node", options.use_topology_node);
  return options;
}

}  // namespace

Result<PlannerNode::Setup> PlannerNode::readSetup(config::Section section) {
  Setup setup;
  setup.node = readNodeOptions(section);
  const auto field = readDistanceFieldOptions(section.child("distance_field"));
  const auto supervisor = mission::readSupervisorOptions(section.child("supervisor"));
  const auto planner = planner::readOptions(section.child("planner"));
  const auto topology = topology::readOptions(section.child("topology"));
  config::Section optimizer = section.child("optimizer");
  const auto local = optimizer::readLocalOptions(optimizer.child("local"));
  const auto global = optimizer::readGlobalOptions(optimizer.child("global"));
  for (const Status& status : {section.finish(), optimizer.finish()}) {
    if (!status) {
      return failure(status.error().message);
    }
  }
  if (!field) {
    return failure(field.error().message);
  }
  if (!supervisor) {
    return failure(supervisor.error().message);
  }
  if (!planner) {
    return failure(planner.error().message);
  }
  if (!topology) {
    return failure(topology.error().message);
  }
  if (!local) {
    return failure(local.error().message);
  }
  if (!global) {
    return failure(global.error().message);
  }
  setup.field = *field;
  setup.supervisor = *supervisor;
  setup.planner = *planner;
  setup.planner.topology = *topology;
  setup.planner.local = *local;
  setup.planner.global = *global;
  return config::vesselFile(setup.node.vessel)
      .and_then([](const std::string& path) { return vessel::loadParameters(path); })
      .map([&](const vessel::Parameters& vessel) {
        setup.vessel = vessel;
        return setup;
      });
}

Result<std::unique_ptr<PlannerNode>> PlannerNode::create(config::Section section) {
  return readSetup(std::move(section)).map([](const Setup& setup) {
    return std::unique_ptr<PlannerNode>(new PlannerNode(setup));
  });
}

}  // namespace otter_nav::nodes
