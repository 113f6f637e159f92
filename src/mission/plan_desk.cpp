#include "otter_nav/mission/plan_desk.hpp"

#include <utility>

namespace otter_nav::mission {

PlanDesk::PlanDesk(const planner::Options& options, const vessel::Parameters& vessel)
    : options_(options), vessel_(vessel) {}

planner::Plan PlanDesk::plan(const PlanRequest& request, const map::DistanceField& field,
                             std::vector<Eigen::Vector2d> guide_path,
                             const planner::Termination& termination) {
  auto found = planners_.find(request.thrust_share);
  if (found == planners_.end()) {
    planner::Planner planner(options_, vessel::withThrustShare(vessel_, request.thrust_share));
    found = planners_.emplace(request.thrust_share, std::move(planner)).first;
  }
  planner::Query query;
  query.start = request.start;
  query.start_psi_rad = request.start_psi_rad;
  query.goal = request.goal.position;
  query.goal_psi_rad = request.goal.psi_rad;
  query.clearance_m = request.clearance_m;
  query.seed = request.seed;
  query.warm_start = request.warm_start.empty() ? nullptr : &request.warm_start;
  query.guide_path = std::move(guide_path);
  return found->second.plan(field, query, termination);
}

PlanReply replyTo(const PlanRequest& request, const planner::Plan& plan) {
  return {request.id, plan.outcome == planner::Outcome::kSolved, plan.reason, plan.trajectory};
}

}  // namespace otter_nav::mission
