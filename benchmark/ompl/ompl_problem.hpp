// One mission as OMPL sees it: geometric (SE2) and kinodynamic (the paper's model under thrusts).
#pragma once

#include <string>
#include <vector>

#include "../shortest_way.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/planner/options.hpp"
#include "otter_nav/scenario/scenario.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::benchmark {

struct OmplProblem {
  const map::DistanceField& field;
  const vessel::Parameters& vessel;
  const planner::Options& options;
  const scenario::Mission& mission;
};

struct OmplBudget {
  double seconds = 1.0;
  int runs = 3;
  std::string log;  // file name without ending; empty: none
};

// Medians over the runs that were solved.
struct OmplRow {
  std::string planner;
  int solved = 0;
  int runs = 0;
  double time_ms = 0.0;
  double length_m = 0.0;
  double duration_s = 0.0;   // 0 for a path without time
  double clearance_m = 0.0;  // least along the way
};

// RRTConnect, RRT*, Informed RRT* in SE2, and ours.
[[nodiscard]] std::vector<OmplRow> runGeometric(const OmplProblem& problem,
                                                const OmplBudget& budget);
// KPIECE1, SST and RRT with the vessel's dynamics, and ours.
[[nodiscard]] std::vector<OmplRow> runKinodynamic(const OmplProblem& problem,
                                                  const OmplBudget& budget);

}  // namespace otter_nav::benchmark
