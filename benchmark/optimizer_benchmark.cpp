// The global optimiser by itself: every mission of a folder of scenarios, along its guide path.
//   optimizer_benchmark --scenarios DIR [--map world] [--vessel otter_gazebo] [--verbose]
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "otter_nav/base/statistics.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/optimizer/global_optimizer.hpp"
#include "otter_nav/scenario/scenario.hpp"
#include "otter_nav/topology/guide_path.hpp"
#include "otter_nav/trajectory/trajectory.hpp"

namespace {

using namespace otter_nav;

constexpr int kRepeats = 3;  // the quickest counts

double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Over the missions of one kind.
struct Tally {
  int missions = 0;
  int last_resorts = 0;
  std::vector<double> cpu_ms, speed_mps, stretch;
};

struct Bench {
  optimizer::GlobalOptimizer optimizer;
  topology::GuidePathFinder finder;
  feasibility::SafetyLimits limits;
  bool verbose = false;
  std::map<std::string, Tally> tallies;

  void sail(const std::string& label, const map::DistanceField& field,
            const scenario::Mission& mission) {
    Tally& tally = tallies[mission.kind];
    ++tally.missions;
    const auto guide = finder.find(field, {mission.start.position, mission.start.psi_rad},
                                   {mission.goal.position, mission.goal.psi_rad});
    if (!guide) {
      std::printf("%s: %s\n", label.c_str(), guide.error().message.c_str());
      return;
    }
    trajectory::Boundary start;
    trajectory::Boundary goal;
    start.flat.position = mission.start.position;
    start.psi_rad = mission.start.psi_rad;
    goal.flat.position = mission.goal.position;
    goal.psi_rad = mission.goal.psi_rad;
    double quickest = 1e9;
    Result<optimizer::Optimized> result = failure("");
    for (int i = 0; i < kRepeats; ++i) {
      const double began = cpuSeconds();
      result = optimizer.optimize(field, guide->points, start, goal, optimizer::Budget(), limits);
      quickest = std::min(quickest, cpuSeconds() - began);
    }
    if (!result) {
      std::printf("%s: %s\n", label.c_str(), result.error().message.c_str());
      return;
    }
    const double length = trajectory::length(result->trajectory);
    const double duration = result->trajectory.duration();
    tally.last_resorts += result->last_resort ? 1 : 0;
    tally.cpu_ms.push_back(1e3 * quickest);
    tally.speed_mps.push_back(length / duration);
    tally.stretch.push_back(length / guide->length_m);
    if (verbose || result->last_resort) {
      std::printf("%s: %d steps, %.2f ms, %.1f m in %.1f s, %.2f m/s, %.3f of the guide path%s\n",
                  label.c_str(), result->iterations, 1e3 * quickest, length, duration,
                  length / duration, length / guide->length_m,
                  result->last_resort ? ", stop and spin" : "");
    }
  }
};

Status run(Bench& bench, const std::string& folder, bool world) {
  const auto files = scenario::scenarioFiles(folder);
  if (!files) {
    return failure(files.error().message);
  }
  for (const std::string& file : *files) {
    const auto scenario = scenario::loadScenario(file);
    if (!scenario) {
      return failure(scenario.error().message);
    }
    const auto grid = map::loadChart(world ? scenario->world_path : scenario->chart_path);
    if (!grid) {
      return failure(grid.error().message);
    }
    const map::DistanceField field(*grid, {});
    for (std::size_t i = 0; i < scenario->missions.size(); ++i) {
      bench.sail(scenario->name + " " + std::to_string(i), field, scenario->missions[i]);
    }
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The global optimiser by itself, along guide paths");
  std::string folder;
  std::string map_name = "world";
  std::string vessel_name = "otter_gazebo";
  bool verbose = false;
  app.add_option("--scenarios", folder, "folder of scenarios")->required();
  app.add_option("--map", map_name)->check(CLI::IsMember({"world", "chart"}));
  app.add_option("--vessel", vessel_name);
  app.add_flag("--verbose", verbose, "a line for each mission");
  CLI11_PARSE(app, argc, argv);
  const auto vessel = vessel::loadParameters(vessel_name);
  if (!vessel) {
    std::fprintf(stderr, "%s\n", vessel.error().message.c_str());
    return 1;
  }
  Bench bench{optimizer::GlobalOptimizer({}, *vessel),
              topology::GuidePathFinder({}),
              feasibility::SafetyLimits::of(*vessel),
              verbose,
              {}};
  if (const Status status = run(bench, folder, map_name == "world"); !status) {
    std::fprintf(stderr, "%s\n", status.error().message.c_str());
    return 1;
  }
  for (const auto& [kind, t] : bench.tallies) {
    std::printf(
        "%s: %zu of %d solved (%d stop and spin); CPU ms median %.2f, 95 %% %.2f; "
        "m/s median %.3f; of the guide path median %.4f\n",
        kind.c_str(), t.cpu_ms.size(), t.missions, t.last_resorts, quantile(t.cpu_ms, 0.5),
        quantile(t.cpu_ms, 0.95), quantile(t.speed_mps, 0.5), quantile(t.stretch, 0.5));
  }
  return 0;
}
