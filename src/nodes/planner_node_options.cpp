#include "map_options.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/config/share.hpp"
#include "planner_node.hpp"

namespace otter_nav::nodes {
Result<PlannerNode::Setup> PlannerNode::readSetup(config::Section section) {
  Setup setup;
  const Status node = config::readFields(section, setup.node);
  const auto field = readDistanceFieldOptions(section.child("distance_field"));
  const auto supervisor = mission::readSupervisorOptions(section.child("supervisor"));
  const auto planner = config::read<planner::Options>(section.child("planner"));
  const auto topology = config::read<topology::Options>(section.child("topology"));
  for (const Status& status : {node, section.finish()}) {
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
  setup.field = *field;
  setup.supervisor = *supervisor;
  setup.planner = *planner;
  setup.planner.topology = *topology;
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
