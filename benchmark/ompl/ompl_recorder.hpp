// What OMPL's benchmark found, in our own figures.
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/tools/benchmark/Benchmark.h>

#include <map>
#include <string>
#include <vector>

#include "ompl_planner.hpp"
#include "ompl_problem.hpp"

namespace otter_nav::benchmark {

class OmplRecorder {
 public:
  explicit OmplRecorder(const map::DistanceField& field) : field_(field) {}

  // To be called after each run.
  void record(const ompl::base::PlannerPtr& planner, const planner::StateAdapter& adapter);
  [[nodiscard]] std::vector<OmplRow> rows(const ompl::tools::Benchmark& benchmark) const;

 private:
  struct Run {
    bool solved = false;
    double length_m = 0.0;
    double duration_s = 0.0;
    double clearance_m = 0.0;
  };
  // Length and clearance, at points 0.05 m apart or closer.
  void measure(const ompl::geometric::PathGeometric& path, const planner::StateAdapter& adapter,
               Run& run) const;

  const map::DistanceField& field_;
  std::map<std::string, std::vector<Run>> runs_;
};

}  // namespace otter_nav::benchmark
