// Writes a seeded archipelago, waters between walls, a narrow field of uncharted cylinders, or
// encounters in open water, with chart, world and missions: --help says how.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "archipelago/archipelago.hpp"
#include "archipelago/cylinder_field.hpp"
#include "archipelago/encounters.hpp"
#include "otter_nav/map/chart.hpp"

namespace {

using otter_nav::failure;
using otter_nav::Result;
using otter_nav::scenario::Encounter;

// What was written, or why nothing was.
Result<std::string> writeCylinders(const otter_nav::scenario::CylinderFieldOptions& options,
                                   std::uint64_t seed, const std::string& folder,
                                   const std::string& name) {
  const auto field = otter_nav::scenario::generateCylinderField(options, seed);
  if (!field) {
    return failure(field.error().message);
  }
  return otter_nav::scenario::saveScenario(folder, name, field->chart, field->world,
                                           {field->mission})
      .map([&] {
        return std::to_string(field->cylinders) + " cylinders, the best way leaves " +
               std::to_string(field->best_m) + " m";
      });
}

struct Encounters {
  std::function<std::vector<Encounter>(std::uint64_t seed, int each)> make;
  double side_m;  // of their water
};
const std::map<std::string, Encounters> kEncounters = {
    {"imazu", {[](auto...) { return otter_nav::scenario::imazuCases(); }, 520.0}},
    {"captains", {[](auto...) { return otter_nav::scenario::stubbornCaptains(); }, 520.0}},
    {"moving", {otter_nav::scenario::movingFields, 80.0}}};

// One scenario a case, all in one open water; how many, or why not.
Result<std::size_t> writeEncounters(const std::string& set, std::uint64_t seed, int each,
                                    const std::string& folder) {
  const Encounters& encounters = kEncounters.at(set);
  const std::string water = set + "_water.yaml";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (const auto saved =
          otter_nav::map::saveChart(otter_nav::scenario::openWater(encounters.side_m),
                                    (std::filesystem::path(folder) / water).string());
      !saved) {
    return failure(saved.error().message);
  }
  std::size_t count = 0;
  std::map<std::string, int> of_kind;
  for (const Encounter& encounter : encounters.make(seed, each)) {
    ++count;
    char number[24];
    std::snprintf(number, sizeof(number), "_%02d", ++of_kind[encounter.kind]);
    const std::string kind = encounter.kind.empty() ? "" : "_" + encounter.kind;
    if (const auto saved = otter_nav::scenario::saveMissions(
            folder, set + kind + number, water, water, {encounter.mission}, encounter.vessels);
        !saved) {
      return failure(saved.error().message);
    }
  }
  return count;
}

constexpr double kClearBetweenWallsM = 3.0;  // at start and goal
const std::map<std::string, otter_nav::scenario::Walls> kWalls = {
    {"streets", otter_nav::scenario::Walls::kStreets},
    {"halls", otter_nav::scenario::Walls::kHalls},
    {"harbour", otter_nav::scenario::Walls::kHarbour}};

// A scenario's file has its name from --name.
std::string aFolder(const std::string& path) {
  return std::filesystem::path(path).extension() == ".yaml"
             ? path + " is to be a folder; --name names the scenario"
             : "";
}

}  // namespace

int main(int argc, char** argv) {
  using otter_nav::scenario::ArchipelagoOptions;
  ArchipelagoOptions options;
  std::uint64_t seed = 1;
  std::string folder = ".";
  std::string name = "archipelago";
  CLI::App app{
      "Writes NAME.yaml, NAME_chart and NAME_world: a seeded archipelago to sail in. "
      "Counts are for 300 m by 300 m and grow with the area."};
  app.add_option("--seed", seed, "same seed, same archipelago")->capture_default_str();
  app.add_option("--out", folder, "folder to write into")
      ->capture_default_str()
      ->check(aFolder, "");
  app.add_option("--name", name, "of the scenario")->capture_default_str();
  app.add_option("--size", options.size_m, "side of the square, m")->capture_default_str();
  app.add_option("--cell", options.resolution_m, "side of a cell, m")->capture_default_str();
  app.add_option("--islands", options.islands)->capture_default_str();
  app.add_option("--breakwaters", options.breakwaters)->capture_default_str();
  app.add_option("--charted", options.charted, "buoys and pontoons in the chart")
      ->capture_default_str();
  app.add_option("--uncharted", options.uncharted, "those only in the world")
      ->capture_default_str();
  app.add_option("--local", options.local_missions, "missions over the local distance")
      ->capture_default_str();
  app.add_option("--local-distance", options.local_distance_m, "m")->capture_default_str();
  app.add_option("--cross", options.cross_missions, "missions across the map")
      ->capture_default_str();
  CLI::Option* vessels =
      app.add_option("--vessels", options.vessels, "others that sail there on bent routes")
          ->capture_default_str();
  std::string walls;
  CLI::Option* walled =
      app.add_option("--walls", walls, "streets, halls or harbour: instead of what the counts say")
          ->check(CLI::IsMember(kWalls));
  otter_nav::scenario::CylinderFieldOptions narrow;
  CLI::Option* cylinders = app.add_flag(
      "--cylinders", "instead: a field of cylinders 13 m by 20 m that the chart doesn't show");
  cylinders->excludes(walled);
  cylinders->excludes(vessels);
  app.add_option("--best-min", narrow.best_min_m, "of its best way's clearance, m")
      ->capture_default_str()
      ->needs(cylinders);
  app.add_option("--best-max", narrow.best_max_m, "likewise")
      ->capture_default_str()
      ->needs(cylinders);
  std::string encounters;
  app.add_option(
         "--encounters", encounters,
         "instead: SET_01.yaml and so on, other vessels in open water: 'imazu', his 22 "
         "cases; 'captains' who never give way; 'moving' (SET_easy_01.yaml and so on, by the "
         "seed), squares on loops: 5 at up to 2 m/s, 12 at up to 3, 24 at up to 4")
      ->check(CLI::IsMember(kEncounters))
      ->excludes(cylinders)
      ->excludes(walled)
      ->excludes(vessels);
  int each = 7;
  app.add_option("--fields", each, "moving: of each difficulty")
      ->capture_default_str()
      ->check(CLI::Range(1, 999));
  CLI11_PARSE(app, argc, argv);

  if (!encounters.empty()) {
    const auto written = writeEncounters(encounters, seed, each, folder);
    if (!written) {
      std::cerr << "scenario_generator: " << written.error().message << '\n';
      return 1;
    }
    std::cout << folder << ": " << *written << " scenarios\n";
    return 0;
  }

  if (*cylinders) {
    const auto written = writeCylinders(narrow, seed, folder, name);
    if (!written) {
      std::cerr << "scenario_generator: " << written.error().message << '\n';
      return 1;
    }
    std::cout << folder << '/' << name << ".yaml: " << *written << '\n';
    return 0;
  }
  if (!walls.empty()) {
    options.walls = kWalls.at(walls);
    options.clear_m = kClearBetweenWallsM;
  }
  const auto archipelago = otter_nav::scenario::generateArchipelago(options, seed);
  if (!archipelago) {
    std::cerr << "scenario_generator: " << archipelago.error().message << '\n';
    return 1;
  }
  const auto saved =
      otter_nav::scenario::saveScenario(folder, name, archipelago->chart, archipelago->world,
                                        archipelago->missions, archipelago->vessels);
  if (!saved) {
    std::cerr << "scenario_generator: " << saved.error().message << '\n';
    return 1;
  }
  std::cout << folder << '/' << name << ".yaml: " << archipelago->missions.size() << " missions, "
            << archipelago->vessels.size() << " vessels\n";
  return 0;
}
