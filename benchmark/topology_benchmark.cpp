// Guide paths on the scenarios' worlds: length over the shortest any-angle path, and time.
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "otter_nav/base/statistics.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/topology/guide_path.hpp"

namespace {

using namespace otter_nav;

struct Case {
  std::string scenario, kind;
  int mission = 0;
  double shortest_m = 0.0;
  topology::Pose start, goal;
};

struct Row {
  double ratio = 0.0;
  double best_ms = 0.0;
  double first_ms = 0.0;
};

double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

topology::Pose poseFrom(const YAML::Node& node) {
  return {{node[0].as<double>(), node[1].as<double>()}, node[2].as<double>()};
}

// The missions of `directory` that shortest.csv has a length for.
std::vector<Case> loadCases(const std::string& directory) {
  std::vector<Case> cases;
  std::ifstream file(directory + "/shortest.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    Case c;
    std::string mission;
    std::string shortest;
    std::getline(fields, c.scenario, ',');
    std::getline(fields, mission, ',');
    std::getline(fields, c.kind, ',');
    std::getline(fields, shortest, ',');
    c.mission = std::stoi(mission);
    c.shortest_m = std::stod(shortest);
    const YAML::Node entry =
        YAML::LoadFile(directory + "/" + c.scenario + ".yaml")["missions"][c.mission];
    c.start = poseFrom(entry["start"]);
    c.goal = poseFrom(entry["goal"]);
    cases.push_back(c);
  }
  return cases;
}

Row measure(topology::GuidePathFinder& finder, const map::DistanceField& field, const Case& c,
            int repeats) {
  Row row;
  row.best_ms = 1e9;
  topology::GuidePath path;
  for (int i = 0; i < repeats; ++i) {
    const double began = cpuSeconds();
    const auto found = finder.find(field, c.start, c.goal, path);
    const double took_ms = 1e3 * (cpuSeconds() - began);
    if (!found) {
      std::printf("%s %d: %s\n", c.scenario.c_str(), c.mission, found.error().message.c_str());
      return row;
    }
    row.first_ms = i == 0 ? took_ms : row.first_ms;
    row.best_ms = std::min(row.best_ms, took_ms);
  }
  row.ratio = path.length_m / c.shortest_m;
  return row;
}

void summarise(const std::string& kind, const std::vector<Row>& rows) {
  std::vector<double> ratios;
  std::vector<double> times;
  for (const Row& row : rows) {
    ratios.push_back(row.ratio);
    times.push_back(row.best_ms);
  }
  std::printf(
      "%-5s %3zu missions  ratio median %.4f 90%% %.4f worst %.4f   ms median %.3f 90%% "
      "%.3f worst %.3f\n",
      kind.c_str(), rows.size(), quantile(ratios, 0.5), quantile(ratios, 0.9),
      quantile(ratios, 1.0), quantile(times, 0.5), quantile(times, 0.9), quantile(times, 1.0));
}

}  // namespace

int main(int argc, char** argv) {
  std::string directory;
  std::string options_path = OTTER_NAV_SOURCE_DIR "/config/topology.yaml";
  int repeats = 5;
  bool each = false;
  CLI::App app("Guide paths on the scenarios' worlds: length and CPU time");
  app.add_option("--scenarios", directory, "folder with shortest.csv")->required();
  app.add_option("--options", options_path, "topology options");
  app.add_option("--repeats", repeats, "runs a mission; the best time counts")
      ->check(CLI::Range(1, 10000));
  app.add_flag("--each", each, "a line for each mission");
  CLI11_PARSE(app, argc, argv);
  const auto options = config::load<topology::Options>(options_path);
  if (!options) {
    std::fprintf(stderr, "%s\n", options.error().message.c_str());
    return 1;
  }
  topology::GuidePathFinder finder(*options);
  std::map<std::string, std::vector<Row>> rows;
  std::map<std::string, map::DistanceField> fields;
  for (const Case& c : loadCases(directory)) {
    if (fields.count(c.scenario) == 0) {
      const auto world = map::loadChart(directory + "/" + c.scenario + "_world.yaml");
      if (!world) {
        std::fprintf(stderr, "%s\n", world.error().message.c_str());
        return 1;
      }
      fields.emplace(c.scenario, map::DistanceField(*world, {}));
    }
    const Row row = measure(finder, fields[c.scenario], c, repeats);
    if (each) {
      std::printf("%s %2d %s  ratio %.4f  %.3f ms (first %.3f)\n", c.scenario.c_str(), c.mission,
                  c.kind.c_str(), row.ratio, row.best_ms, row.first_ms);
    }
    rows[c.kind].push_back(row);
  }
  for (const auto& [kind, all] : rows) {
    summarise(kind, all);
  }
  return rows.empty() ? 1 : 0;
}
