#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "otter_nav/config/share.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/simulation/closed_loop.hpp"

namespace otter_nav::simulation {
namespace {

// A shipped file, read by `reader`.
template <typename Options>
Status readShipped(const std::string& file,
                   const std::function<Result<Options>(const std::string&)>& reader,
                   Options& options) {
  const Result<std::string> path = config::findFile(file);
  if (!path) {
    return failure(path.error().message);
  }
  Result<Options> read = reader(*path);
  if (!read) {
    return failure(read.error().message);
  }
  options = std::move(*read);
  return {};
}

// With the optimiser's and the topology's options beside it.
Result<planner::Options> loadPlannerOptions(const std::string& path) {
  return planner::loadOptions(std::filesystem::path(path).parent_path().string());
}

Status readVessel(const std::string& name, LoopOptions& options) {
  const Result<std::string> path = config::vesselFile(name);
  if (!path) {
    return failure(path.error().message);
  }
  Result<vessel::Parameters> vessel = vessel::loadParameters(*path);
  if (!vessel) {
    return failure(vessel.error().message);
  }
  options.vessel = std::move(*vessel);
  return {};
}

Status readPlant(const std::string& disturbance, LoopOptions& options) {
  const Result<std::string> file = config::findFile("config/plant.yaml");
  const Result<std::string> preset =
      config::findFile("config/disturbances/" + disturbance + ".yaml");
  if (!file || !preset) {
    return failure(!file ? file.error().message : preset.error().message);
  }
  Result<plant::Options> plant = plant::loadOptions(options.vessel, *file, *preset);
  if (!plant) {
    return failure(plant.error().message);
  }
  options.plant = std::move(*plant);
  return {};
}

}  // namespace

Result<LoopOptions> loadLoopOptions(const std::string& vessel, const std::string& disturbance) {
  LoopOptions o;
  const std::function<Status()> steps[] = {
      [&] { return readVessel(vessel, o); },
      [&] { return readPlant(disturbance, o); },
      [&] {
        return readShipped<planner::Options>("config/planner.yaml", loadPlannerOptions, o.planner);
      },
      [&] {
        return readShipped<tracker::Options>("config/tracker.yaml", tracker::loadOptions,
                                             o.tracker);
      },
      [&] {
        return readShipped<map::OccupancyMapOptions>("config/map.yaml",
                                                     map::loadOccupancyMapOptions, o.map);
      },
      [&] {
        return readShipped<mission::SupervisorOptions>(
            "config/mission.yaml", mission::loadSupervisorOptions, o.supervisor);
      }};
  for (const auto& step : steps) {
    if (const Status status = step(); !status) {
      return failure(status.error().message);
    }
  }
  return o;
}

Result<Waters> loadWaters(const scenario::Scenario& scenario) {
  Result<map::OccupancyGrid> chart = map::loadChart(scenario.chart_path);
  if (!chart) {
    return failure(chart.error().message);
  }
  Result<map::OccupancyGrid> world = map::loadChart(scenario.world_path);
  if (!world) {
    return failure(world.error().message);
  }
  return Waters{std::move(*chart), std::move(*world)};
}

scenario::MissionResult run(ClosedLoop& loop, const scenario::MissionLabel& label,
                            double record_period_s, scenario::TrackWriter* track,
                            const std::function<void(const scenario::Progress&)>& progress) {
  constexpr double kProgressS = 0.5;
  double next_record_s = loop.time();
  double next_progress_s = loop.time();
  bool going = true;
  while (going) {
    going = loop.step();
    if (track != nullptr && (loop.time() >= next_record_s || !going)) {
      track->write(loop.motion());
      next_record_s += record_period_s;
    }
    if (progress && (loop.time() >= next_progress_s || !going)) {
      progress(loop.progress());
      next_progress_s += kProgressS;
    }
  }
  return loop.result(label);
}

}  // namespace otter_nav::simulation
