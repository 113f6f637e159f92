#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/config/share.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/simulation/closed_loop.hpp"
#include "otter_nav/simulation/monitor.hpp"

namespace otter_nav::simulation {
namespace {

// With the optimiser's and the topology's options beside it.
Result<planner::Options> loadPlannerOptions(const std::string& path) {
  return planner::loadOptions(std::filesystem::path(path).parent_path().string());
}

}  // namespace

Result<LoopOptions> loadLoopOptions(const std::string& vessel, const std::string& disturbance) {
  const auto own = vessel::loadParameters(vessel);
  const auto plant = own.and_then([&](const vessel::Parameters& parameters) {
    return config::findFile("config/plant.yaml").and_then([&](const std::string& path) {
      return plant::loadOptions(parameters, path, disturbance);
    });
  });
  const auto planner = config::findFile("config/planner.yaml").and_then(loadPlannerOptions);
  const auto tracker =
      config::findFile("config/tracker.yaml").and_then(config::load<tracker::Options>);
  const auto map = config::findFile("config/map.yaml").and_then(map::loadOccupancyMapOptions);
  const auto supervisor =
      config::findFile("config/mission.yaml").and_then(mission::loadSupervisorOptions);
  const auto traffic =
      config::findFile("config/traffic.yaml").and_then(config::load<traffic::Options>);
  if (const Status status = firstFailure(own, plant, planner, tracker, map, supervisor, traffic);
      !status) {
    return failure(status.error().message);
  }
  LoopOptions o;
  o.vessel = *own;
  o.plant = *plant;
  o.planner = *planner;
  o.tracker = *tracker;
  o.map = *map;
  o.supervisor = *supervisor;
  o.traffic = *traffic;
  return o;
}

Result<Waters> loadWaters(const scenario::Scenario& scenario) {
  Result<map::OccupancyGrid> chart = map::loadChart(scenario.chart_path);
  Result<map::OccupancyGrid> world = map::loadChart(scenario.world_path);
  if (const Status status = firstFailure(chart, world); !status) {
    return failure(status.error().message);
  }
  return Waters{std::move(*chart), std::move(*world), scenario.vessels};
}

scenario::MissionResult run(ClosedLoop& loop, const scenario::MissionLabel& label,
                            double record_period_s, scenario::TableWriter* track,
                            const std::function<void(const scenario::Progress&)>& progress,
                            scenario::TableWriter* vessels, Monitor* monitor) {
  constexpr double kProgressS = 0.5;
  double next_record_s = loop.time();
  double next_progress_s = loop.time();
  bool going = true;
  while (going) {
    going = loop.step();
    if (monitor != nullptr) {
      monitor->watch(loop);
    }
    if (loop.time() >= next_record_s || !going) {
      if (track != nullptr) {
        track->write(scenario::trackRow(loop.motion()));
      }
      for (const plant::OtherVessel& other : loop.others()) {
        if (vessels != nullptr) {
          vessels->write(scenario::vesselRow(loop.time(), other.id, other.motion));
        }
      }
      next_record_s += record_period_s;
    }
    if (progress && (loop.time() >= next_progress_s || !going)) {
      progress(loop.progress());
      next_progress_s += kProgressS;
    }
  }
  scenario::MissionResult result = loop.result(label);
  if (monitor != nullptr) {
    result.monitored = monitor->result();
  }
  return result;
}

}  // namespace otter_nav::simulation
