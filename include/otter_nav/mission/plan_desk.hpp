// Answers the supervisor's requests with the planner: one planner for each clearance asked for, as
// a planner keeps its clearance for life.
#pragma once

#include <map>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::mission {

class PlanDesk {
 public:
  // `options.clearance_m` is replaced by each request's.
  PlanDesk(const planner::Options& options, const vessel::Parameters& vessel);

  struct Answer {
    PlanReply reply;
    planner::Plan plan;  // its trajectory is moved into the reply
  };
  // One thread at a time.
  [[nodiscard]] Answer answer(const PlanRequest& request, const map::DistanceField& field,
                              const planner::Termination& termination);

 private:
  planner::Options options_;
  vessel::Parameters vessel_;
  std::map<double, planner::Planner> planners_;
};

}  // namespace otter_nav::mission
