// What the thrusters of otter_gazebo can do at best on a path under a disturbance: the plan of each
// instant knows the wind and the current exactly, for seconds ahead or as they are now.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

#include "otter_nav/config/share.hpp"
#include "otter_nav/plant/simulator.hpp"
#include "tracking/foresight.hpp"
#include "tracking/paths.hpp"

namespace {

using namespace otter_nav;

struct Arguments {
  std::string path = "eight";
  std::string disturbance = "hard";
  double top_speed_mps = 1.5;
  double horizon_s = 6.0;
  std::uint64_t seed = 1;
  bool now_only = false;
};

Result<plant::Options> plantOptions(const Arguments& a, const vessel::Parameters& vessel) {
  const auto plant_file = config::findFile("config/plant.yaml");
  if (!plant_file) {
    return failure(plant_file.error().message);
  }
  return plant::loadOptions(vessel, *plant_file, a.disturbance);
}

// Wind and current at each step. Neither depends on the vessel, and this vessel's waves do not
// carry it along.
std::vector<vessel::Disturbance> weather(const plant::Options& options, std::uint64_t seed,
                                         double step_s, std::size_t count) {
  plant::Simulator simulator(options, map::OccupancyGrid{}, seed);
  std::vector<vessel::Disturbance> result(count);
  for (vessel::Disturbance& d : result) {
    simulator.step(vessel::Thrusts::Zero(), 0.5 * step_s);
    d.wind_mps = simulator.truth().wind_mps;
    d.current_mps = simulator.truth().current_mps;
    d.force_n = options.disturbance.force_n;
    simulator.step(vessel::Thrusts::Zero(), 0.5 * step_s);
  }
  return result;
}

int runOnce(const Arguments& a) {
  const auto vessel = vessel::loadParameters("otter_gazebo");
  const auto options = vessel.and_then([&](const auto& v) { return plantOptions(a, v); });
  if (!options) {
    std::cerr << "tracking_limit: " << options.error().message << "\n";
    return 1;
  }
  benchmark::ForesightPlanner::Options planner_options;
  planner_options.stages = static_cast<int>(a.horizon_s / planner_options.step_s);
  benchmark::ForesightPlanner planner(planner_options, *vessel);
  const auto path =
      a.path == "eight" ? benchmark::eight(a.top_speed_mps) : benchmark::spiral(a.top_speed_mps);
  const double step = planner_options.step_s;
  const auto horizon = static_cast<std::size_t>(planner_options.stages);
  const auto cycles = static_cast<std::size_t>((path.duration() - benchmark::kRunOutS) / step);
  const auto all = weather(*options, a.seed, step, cycles + horizon);

  vessel::State x = vessel::State::Zero();
  x.head<3>() = path.sample(0.0, *vessel).state.head<3>();
  std::vector<Eigen::Vector2d> positions(horizon + 1);
  double sum = 0.0;
  double largest = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < cycles; ++i) {
    for (std::size_t k = 0; k <= horizon; ++k) {
      positions[k] = path.flat(static_cast<double>(i + k) * step).position;
    }
    std::vector<vessel::Disturbance> known(horizon, all[i]);
    if (!a.now_only) {
      std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(i), horizon, known.begin());
    }
    if (static_cast<double>(i) * step >= 10.0) {
      const double error = (x.head<2>() - positions[0]).norm();
      sum += error;
      largest = std::max(largest, error);
      ++count;
    }
    x = planner.advance(x, planner.plan(x, positions, known), all[i]);
  }
  std::printf("%s, %s, seed %llu, %s: mean error %.3f m, largest %.2f m\n", a.path.c_str(),
              a.disturbance.c_str(), static_cast<unsigned long long>(a.seed),
              a.now_only ? "wind and current of the instant" : "gusts known ahead",
              sum / std::max(1, count), largest);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app("The least tracking error of otter_gazebo with perfect knowledge of the weather.");
  app.add_option("--path", a.path, "eight or spiral")
      ->check(CLI::IsMember({"eight", "spiral"}))
      ->capture_default_str();
  app.add_option("--disturbance", a.disturbance, "none, force10, paper, hard")
      ->check(CLI::IsMember({"none", "force10", "paper", "hard"}))
      ->capture_default_str();
  app.add_option("--top-speed", a.top_speed_mps, "m/s")
      ->check(CLI::Range(0.1, 20.0))
      ->capture_default_str();
  app.add_option("--horizon", a.horizon_s, "s")
      ->check(CLI::Range(0.5, 30.0))
      ->capture_default_str();
  app.add_option("--seed", a.seed, "of the weather")->capture_default_str();
  app.add_flag("--now-only", a.now_only, "gusts are not known ahead, only the present wind");
  CLI11_PARSE(app, argc, argv);
  return runOnce(a);
}
