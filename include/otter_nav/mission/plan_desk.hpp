// Answers the supervisor's requests with the planner.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::mission {

class PlanDesk {
 public:
  PlanDesk(const planner::Options& options, const vessel::Parameters& vessel);

  // `guide_path`: key points found elsewhere (a topology node); empty: found here. One thread at a
  // time.
  [[nodiscard]] planner::Plan plan(const PlanRequest& request, const map::DistanceField& field,
                                   std::vector<Eigen::Vector2d> guide_path,
                                   const planner::Termination& termination);

 private:
  vessel::Parameters vessel_;
  planner::Planner planner_;
};

}  // namespace otter_nav::mission
