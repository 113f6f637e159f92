#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/config/share.hpp"
#include "planner_node.hpp"

namespace otter_nav::nodes {
Result<PlannerNode::Setup> PlannerNode::readSetup(config::Section section) {
  Setup setup;
  const Status node = config::readFields(section, setup.node);
  const auto supervisor = mission::readSupervisorOptions(section.child("supervisor"));
  const auto planner = config::read<planner::Options>(section.child("planner"));
  const auto topology = config::read<topology::Options>(section.child("topology"));
  const auto vessel = config::vesselFile(setup.node.vessel).and_then(vessel::loadParameters);
  if (const Status status =
          firstFailure(node, section.finish(), supervisor, planner, topology, vessel);
      !status) {
    return failure(status.error().message);
  }
  setup.vessel = *vessel;
  setup.supervisor = *supervisor;
  setup.planner = *planner;
  setup.planner.topology = *topology;
  return setup;
}

Result<std::unique_ptr<PlannerNode>> PlannerNode::create(config::Section section) {
  return readSetup(std::move(section)).map([](const Setup& setup) {
    return std::unique_ptr<PlannerNode>(new PlannerNode(setup));
  });
}

}  // namespace otter_nav::nodes
