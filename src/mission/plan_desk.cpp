#include "otter_nav/mission/plan_desk.hpp"

#include <utility>

namespace otter_nav::mission {

PlanDesk::PlanDesk(const planner::Options& options, const vessel::Parameters& vessel)
    : options_(options), vessel_(vessel) {}

planner::Plan PlanDesk::plan(const PlanRequest& request, const map::DistanceField& field,
                             std::vector<Eigen::Vector2d> guide_path,
                             const planner::Termination& termination) {
  const double share = request.limits.thrust_share;
  auto found = planners_.find(share);
  if (found == planners_.end()) {
    planner::Planner planner(options_, vessel::withThrustShare(vessel_, share));
    found = planners_.emplace(share, std::move(planner)).first;
  }
  planner::Query query = request.query;
  query.clearance_m = request.limits.clearance_m;
  query.warm_start = request.warm_start.empty() ? nullptr : &request.warm_start;
  query.guide_path = std::move(guide_path);
  return found->second.plan(field, query, termination);
}

}  // namespace otter_nav::mission
