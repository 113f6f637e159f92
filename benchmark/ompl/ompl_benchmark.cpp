// This planner beside OMPL's geometric and kinodynamic ones on one mission, run by
// ompl::tools::Benchmark. What comes out is measured alike: length of the way, its duration where
// there is one, and the clearance of the whole way, tested continuously.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

#include "ompl_problem.hpp"
#include "otter_nav/config/share.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/scenario/scenario.hpp"

namespace {

using namespace otter_nav;

struct Request {
  std::string scenario;
  int mission = 0;
  std::string map = "world";
  std::string vessel = "otter_gazebo";
  double seconds = 1.0;
  int runs = 3;
  std::string out;
};

int fail(const std::string& message) {
  std::cerr << "ompl_benchmark: " << message << "\n";
  return 1;
}

void addOptions(CLI::App& app, Request& r) {
  app.add_option("--scenario", r.scenario, "scenario file")->required()->check(CLI::ExistingFile);
  app.add_option("--mission", r.mission, "its number")->capture_default_str();
  app.add_option("--map", r.map)->check(CLI::IsMember({"world", "chart"}))->capture_default_str();
  app.add_option("--vessel", r.vessel, "name in config/vessels or a file")->capture_default_str();
  app.add_option("--seconds", r.seconds, "for one run of one planner")
      ->check(CLI::Range(0.01, 600.0))
      ->capture_default_str();
  app.add_option("--runs", r.runs)->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--out", r.out, "OMPL log file, for its Planner Arena");
}

void printRows(const std::vector<benchmark::OmplRow>& rows, double shortest_m) {
  std::printf("%-22s %8s %12s %10s %10s %8s %12s\n", "planner", "solved", "time ms", "length m",
              "/shortest", "sails s", "clearance m");
  for (const auto& row : rows) {
    std::printf("%-22s %5d/%-2d %12.2f %10.1f %10.2f %8.1f %12.2f\n", row.planner.c_str(),
                row.solved, row.runs, row.time_ms, row.length_m,
                shortest_m > 0.0 ? row.length_m / shortest_m : 0.0, row.duration_s,
                row.clearance_m);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app("Runs this planner beside OMPL's on one mission.");
  addOptions(app, request);
  CLI11_PARSE(app, argc, argv);
  const auto scenario = scenario::loadScenario(request.scenario);
  if (!scenario) {
    return fail(scenario.error().message);
  }
  const auto mission = scenario::missionOf(*scenario, request.mission);
  const auto share = config::shareDirectory();
  if (!mission || !share) {
    return fail(!mission ? mission.error().message : share.error().message);
  }
  const auto vessel = vessel::loadParameters(request.vessel);
  const auto options = planner::loadOptions(*share + "/config");
  const auto grid =
      map::loadChart(request.map == "world" ? scenario->world_path : scenario->chart_path);
  if (!vessel || !options || !grid) {
    return fail(!vessel    ? vessel.error().message
                : !options ? options.error().message
                           : grid.error().message);
  }
  const map::DistanceField field(*grid, map::DistanceFieldOptions{});
  const benchmark::OmplProblem problem{field, *vessel, *options, *mission};
  const double shortest_m = benchmark::anyAngleLength(field, mission->start.position,
                                                      mission->goal.position, benchmark::kGrowthM);
  const benchmark::OmplBudget budget{request.seconds, request.runs, request.out};
  printRows(benchmark::runGeometric(problem, budget), shortest_m);
  printRows(benchmark::runKinodynamic(problem, budget), shortest_m);
  return 0;
}
