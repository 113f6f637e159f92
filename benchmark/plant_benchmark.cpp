// How many times faster than real time the plants run, and what a lidar scan costs: processor time
// of this thread, so that what else the machine does matters little.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "otter_nav/base/random.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/plant/simulator.hpp"

namespace {

using namespace otter_nav;

struct Arguments {
  std::string config = OTTER_NAV_SOURCE_DIR "/config";
  std::string world;
  std::string out;
  double seconds = 300.0;
  int scans = 300;
};

double processorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// 300 m by 300 m with islands and floating obstacles, as the scenarios have them.
map::OccupancyGrid archipelago() {
  constexpr int kSide = 1200;
  constexpr int kIslands = 40;
  constexpr int kFloats = 60;
  map::OccupancyGrid grid;
  grid.geometry = {kSide, kSide, 0.25, Eigen::Vector2d::Zero()};
  grid.cells.assign(static_cast<std::size_t>(kSide) * kSide, map::Cell::kFree);
  Random random(1);
  for (int i = 0; i < kIslands + kFloats; ++i) {
    const Eigen::Vector2d centre(random.uniform(0.0, 300.0), random.uniform(0.0, 300.0));
    const double radius = i < kIslands ? random.uniform(4.0, 15.0) : random.uniform(0.3, 1.0);
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        if ((grid.geometry.centreOf(column, row) - centre).norm() < radius) {
          grid.cells[grid.geometry.index(column, row)] = map::Cell::kOccupied;
        }
      }
    }
  }
  return grid;
}

// Best of a few stretches: simulated seconds in one of processor time.
double realTimeFactor(const plant::Options& options, const map::OccupancyGrid& world,
                      double seconds) {
  constexpr int kStretches = 5;
  constexpr double kStep = 0.01;
  plant::Simulator simulator(options, world, 1);
  simulator.placeAt({150.0, 150.0}, 0.0);
  double best = 0.0;
  for (int stretch = 0; stretch < kStretches; ++stretch) {
    const int steps = static_cast<int>(seconds / kStretches / kStep);
    const double start = processorSeconds();
    for (int i = 0; i < steps; ++i) {
      simulator.step({40.0, 30.0}, kStep);
    }
    best = std::max(best, steps * kStep / (processorSeconds() - start));
  }
  return best;
}

struct ScanTimes {
  double median_ms = 0.0;
  double max_ms = 0.0;
};

ScanTimes scanTimes(const plant::Options& options, const map::OccupancyGrid& world, int scans) {
  plant::Simulator simulator(options, world, 1);
  Random random(2);
  std::vector<double> times;
  const map::GridGeometry& g = world.geometry;
  while (static_cast<int>(times.size()) < scans) {
    const Eigen::Vector2d position =
        g.origin + g.resolution_m *
                       Eigen::Vector2d(random.uniform(0.0, g.width), random.uniform(0.0, g.height));
    simulator.placeAt(position, random.uniform(-3.0, 3.0));
    if (simulator.inContact()) {
      continue;
    }
    const double start = processorSeconds();
    (void)simulator.scan();
    times.push_back(1e3 * (processorSeconds() - start));
  }
  std::sort(times.begin(), times.end());
  return {times[times.size() / 2], times.back()};
}

Result<nlohmann::json> measure(const Arguments& a) {
  Result<map::OccupancyGrid> world =
      a.world.empty() ? Result<map::OccupancyGrid>(archipelago()) : map::loadChart(a.world);
  if (!world) {
    return failure(world.error().message);
  }
  nlohmann::json report;
  std::printf("times real time, no lidar (step 0.01 s)\n");
  for (const char* vessel : {"otter", "otter_gazebo"}) {
    const Result<vessel::Parameters> parameters =
        vessel::loadParameters(a.config + "/vessels/" + vessel + ".yaml");
    if (!parameters) {
      return failure(parameters.error().message);
    }
    for (const char* preset : {"none", "force10", "paper", "hard"}) {
      const Result<plant::Options> options = plant::loadOptions(
          *parameters, a.config + "/plant.yaml", a.config + "/disturbances/" + preset + ".yaml");
      if (!options) {
        return failure(options.error().message);
      }
      const double factor = realTimeFactor(*options, *world, a.seconds);
      std::printf("  %-13s %-8s %8.0f\n", vessel, preset, factor);
      report["real_time_factor"][vessel][preset] = factor;
    }
  }
  const plant::Options options;
  const ScanTimes times = scanTimes(options, *world, a.scans);
  std::printf("lidar, %d beams on %d by %d cells: median %.3f ms, max %.3f ms\n",
              options.lidar.beams, world->geometry.width, world->geometry.height, times.median_ms,
              times.max_ms);
  report["scan_ms"] = {{"median", times.median_ms}, {"max", times.max_ms}};
  return report;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Measures the plants' real-time factor and the lidar's scan time");
  Arguments arguments;
  app.add_option("--config", arguments.config, "folder with plant.yaml, vessels and disturbances")
      ->capture_default_str();
  app.add_option("--world", arguments.world, "map_server YAML; a made archipelago if absent");
  app.add_option("--seconds", arguments.seconds, "simulated for each row")
      ->check(CLI::Range(1.0, 1e5))
      ->capture_default_str();
  app.add_option("--scans", arguments.scans)->check(CLI::Range(1, 100000))->capture_default_str();
  app.add_option("--out", arguments.out, "JSON file");
  CLI11_PARSE(app, argc, argv);
  const Result<nlohmann::json> report = measure(arguments);
  if (!report) {
    std::fprintf(stderr, "plant_benchmark: %s\n", report.error().message.c_str());
    return 1;
  }
  if (!arguments.out.empty()) {
    std::ofstream out(arguments.out);
    out << report->dump(2) << '\n';
    out.close();
    if (!out) {
      std::fprintf(stderr, "plant_benchmark: %s cannot be written\n", arguments.out.c_str());
      return 1;
    }
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "plant_benchmark: %s\n", e.what());
  return 1;
}
