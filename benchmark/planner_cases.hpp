// The planner benchmark's cases: scenarios, missions, seeds and the paper's four methods.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/scenario/scenario.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "planner_load.hpp"

namespace otter_nav::benchmark {

struct Request {
  std::string scenarios;      // folder
  std::string map = "world";  // or chart
  std::string kind = "all";   // local, cross or all
  int seeds = 3;
  double budget_ms = 1000.0;
  std::string clock = "wall";  // or cpu: this thread's, for a machine that is busy
  std::vector<std::string> methods = {"proposed"};
  std::string vessel = "otter_gazebo";
  std::string config;  // folder of planner.yaml and its neighbours
  std::string dump;    // folder; empty: no dumps
  Load load;
  UnderWay under_way;
};

struct Case {
  std::string scenario;
  int mission = 0;
  std::string kind;
  std::uint64_t seed = 1;
  std::string method;
  bool success = false;
  std::string reason;
  planner::Figures figures;
  double shortest_m = 0.0;
  std::string dump;
};

struct Outcome {
  std::string vessel;
  std::vector<Case> cases;
  std::vector<double> field_ms;  // distance field of each scenario
};

// The options of one of the paper's rows.
[[nodiscard]] Result<planner::Options> methodOptions(const planner::Options& shipped,
                                                     const std::string& method);

// Runs everything; `progress(done, all)` after each case. Errors name the file or flag.
[[nodiscard]] Result<Outcome> runCases(const Request& request,
                                       const std::function<void(int, int)>& progress);

// The scenario files of a folder, sorted; an error when there is none.
[[nodiscard]] Result<std::vector<std::string>> scenarioFiles(const std::string& folder);

}  // namespace otter_nav::benchmark
