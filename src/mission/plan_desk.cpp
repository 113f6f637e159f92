#include "otter_nav/mission/plan_desk.hpp"

#include <utility>

namespace otter_nav::mission {

PlanDesk::PlanDesk(const planner::Options& options, const vessel::Parameters& vessel)
    : vessel_(vessel), planner_(options, vessel) {}

planner::Plan PlanDesk::plan(const PlanRequest& request, const map::DistanceField& field,
                             std::vector<Eigen::Vector2d> guide_path,
                             const planner::Termination& termination) {
  planner::Query query = request.query;
  query.limits = feasibility::SafetyLimits::of(vessel_, request.limits.clearance_m,
                                               request.limits.thrust_share);
  query.warm_start = request.warm_start;
  query.guide_path = std::move(guide_path);
  return planner_.plan(field, query, termination);
}

}  // namespace otter_nav::mission
