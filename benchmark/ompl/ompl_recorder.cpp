#include "ompl_recorder.hpp"

#include <ompl/control/PathControl.h>

#include <algorithm>
#include <cmath>

#include "otter_nav/base/parts.hpp"

namespace otter_nav::benchmark {
namespace {

template <typename Runs, typename Value>
double medianOfSolved(const Runs& runs, const Value& value) {
  std::vector<double> values;
  for (const auto& run : runs) {
    if (run.solved) {
      values.push_back(value(run));
    }
  }
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

}  // namespace

void OmplRecorder::record(const ompl::base::PlannerPtr& planner,
                          const planner::StateAdapter& adapter) {
  Run run;
  const auto& definition = planner->getProblemDefinition();
  run.solved = definition->hasExactSolution();
  if (run.solved) {
    const ompl::base::PathPtr path = definition->getSolutionPath();
    if (const auto* control = dynamic_cast<const ompl::control::PathControl*>(path.get())) {
      run.duration_s = control->length();
      measure(control->asGeometric(), adapter, run);
    } else if (const auto* states =
                   dynamic_cast<const ompl::geometric::PathGeometric*>(path.get())) {
      measure(*states, adapter, run);
    }
    if (const auto* ours = dynamic_cast<const planner::OmplPlanner*>(planner.get())) {
      run.duration_s = ours->plan().trajectory.duration();
    }
  }
  runs_[planner->getName()].push_back(run);
}

std::vector<OmplRow> OmplRecorder::rows(const ompl::tools::Benchmark& benchmark) const {
  std::vector<OmplRow> rows;
  for (const auto& experiment : benchmark.getRecordedExperimentData().planners) {
    const auto found = runs_.find(experiment.name.substr(experiment.name.find('_') + 1));
    OmplRow row;
    row.planner = experiment.name;
    row.runs = static_cast<int>(experiment.runs.size());
    if (found != runs_.end()) {
      const std::vector<Run>& runs = found->second;
      row.solved = static_cast<int>(
          std::count_if(runs.begin(), runs.end(), [](const Run& r) { return r.solved; }));
      row.length_m = medianOfSolved(runs, [](const Run& r) { return r.length_m; });
      row.duration_s = medianOfSolved(runs, [](const Run& r) { return r.duration_s; });
      row.clearance_m = medianOfSolved(runs, [](const Run& r) { return r.clearance_m; });
    }
    std::vector<double> times;
    for (const auto& run : experiment.runs) {
      times.push_back(1e3 * std::stod(run.at("time REAL")));
    }
    std::sort(times.begin(), times.end());
    row.time_ms = times.empty() ? 0.0 : times[times.size() / 2];
    rows.push_back(row);
  }
  return rows;
}

void OmplRecorder::measure(const ompl::geometric::PathGeometric& path,
                           const planner::StateAdapter& adapter, Run& run) const {
  constexpr double kSpacingM = 0.05;
  run.clearance_m = field_.maxDistance();
  for (std::size_t i = 0; i + 1 < path.getStateCount(); ++i) {
    const Eigen::Vector2d from = adapter.pose(path.getState(i)).position;
    const Eigen::Vector2d to = adapter.pose(path.getState(i + 1)).position;
    const double length = (to - from).norm();
    run.length_m += length;
    const int parts = partsOf(length, kSpacingM);
    for (int k = 0; k <= parts; ++k) {
      const Eigen::Vector2d p = from + (to - from) * k / parts;
      run.clearance_m = std::min(run.clearance_m, field_.clearance(p));
    }
  }
}

}  // namespace otter_nav::benchmark
