#include "otter_nav/mission/plan_desk.hpp"

#include <utility>

namespace otter_nav::mission {

PlanDesk::PlanDesk(const planner::Options& options, const vessel::Parameters& vessel)
    : options_(options), vessel_(vessel) {}

PlanDesk::Answer PlanDesk::answer(const PlanRequest& request, const map::DistanceField& field,
                                  const planner::Termination& termination) {
  auto found = planners_.find(request.clearance_m);
  if (found == planners_.end()) {
    planner::Options options = options_;
    options.clearance_m = request.clearance_m;
    found = planners_.emplace(request.clearance_m, planner::Planner(options, vessel_)).first;
  }
  planner::Query query;
  query.start = request.start;
  query.start_psi_rad = request.start_psi_rad;
  query.goal = request.goal.position;
  query.goal_psi_rad = request.goal.psi_rad;
  query.seed = request.seed;
  query.warm_start = request.warm_start.empty() ? nullptr : &request.warm_start;
  Answer answer;
  answer.plan = found->second.plan(field, query, termination);
  answer.reply.id = request.id;
  answer.reply.solved = answer.plan.outcome == planner::Outcome::kSolved;
  answer.reply.reason = answer.plan.reason;
  answer.reply.trajectory = std::move(answer.plan.trajectory);
  return answer;
}

}  // namespace otter_nav::mission
