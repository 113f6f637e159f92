// Sails missions of scenarios in the closed loop without ROS and prints what came of them.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "otter_nav/base/progress_line.hpp"
#include "otter_nav/simulation/closed_loop.hpp"

namespace {

namespace fs = std::filesystem;
namespace scenario = otter_nav::scenario;
namespace simulation = otter_nav::simulation;
using otter_nav::failure;
using otter_nav::Result;
using otter_nav::Status;

struct Arguments {
  std::string scenarios;
  std::string missions;  // empty: each scenario's cross ones, or all if there are none
  std::string vessel = "otter_gazebo";
  std::string disturbance = "paper";
  std::string out;
  std::string tracks;
  std::uint64_t seed = 1;
  bool resume = false;
  bool known = false;  // the chart shows the world
};

// "3", "10-13" or "0,2,10-13".
Result<std::vector<int>> parseMissions(const std::string& text) {
  std::vector<int> missions;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    int first = 0;
    int last = 0;
    char rest = 0;
    const int read = std::sscanf(part.c_str(), "%d-%d%c", &first, &last, &rest);
    if (read != 1 && read != 2) {
      return failure("--missions: '" + part + "' is neither a number nor a range like 10-13");
    }
    last = read == 1 ? first : last;
    if (first < 0 || last < first || last > 100000) {
      return failure("--missions: '" + part + "' is not a rising range");
    }
    for (int k = first; k <= last; ++k) {
      missions.push_back(k);
    }
  }
  return missions;
}

std::vector<int> defaultMissions(const scenario::Scenario& scenario) {
  std::vector<int> cross;
  std::vector<int> all;
  for (const scenario::Mission& mission : scenario.missions) {
    const int index = static_cast<int>(all.size());
    all.push_back(index);
    if (mission.kind == "cross") {
      cross.push_back(index);
    }
  }
  return cross.empty() ? all : cross;
}

// The reverse of scenario::toJson; throws nlohmann::json::exception.
scenario::MissionResult resultOf(const nlohmann::json& json) {
  const auto number = [&](const char* key) {  // JSON has no infinity
    return json.at(key).is_null() ? std::numeric_limits<double>::infinity()
                                  : json.at(key).get<double>();
  };
  scenario::MissionResult result;
  result.label = {json.at("scenario"), json.at("mission"), json.at("vessel"),
                  json.at("disturbance"), json.at("seed")};
  const std::string outcome = json.at("outcome");
  for (const auto candidate :
       {scenario::Outcome::kArrived, scenario::Outcome::kStopped, scenario::Outcome::kCollided,
        scenario::Outcome::kTimeout, scenario::Outcome::kError}) {
    if (outcome == scenario::name(candidate)) {
      result.outcome = candidate;
    }
  }
  result.reason = json.value("reason", "");
  result.duration_s = number("duration_s");
  result.distance_m = number("distance_m");
  result.min_clearance_m = number("min_clearance_m");
  result.tracking_error_mean_m = number("tracking_error_mean_m");
  result.tracking_error_max_m = number("tracking_error_max_m");
  result.replans = json.at("replans");
  result.planning_ms_median = number("planning_ms_median");
  result.planning_ms_max = number("planning_ms_max");
  result.tracker_ms_p99 = number("tracker_ms_p99");
  result.track = json.at("track");
  return result;
}

// What a campaign that was stopped has left; nothing if it had not come to its first result.
Result<std::vector<scenario::MissionResult>> loadResults(const std::string& path) {
  std::vector<scenario::MissionResult> results;
  if (!fs::exists(path)) {
    return results;
  }
  try {
    std::ifstream file(path);
    const nlohmann::json all = nlohmann::json::parse(file);
    for (const nlohmann::json& mission : all.at("missions")) {
      results.push_back(resultOf(mission));
    }
  } catch (const nlohmann::json::exception& error) {
    return failure("--resume: " + path + " is no result JSON: " + error.what());
  }
  return results;
}

bool same(const scenario::MissionLabel& a, const scenario::MissionLabel& b) {
  return a.scenario == b.scenario && a.mission == b.mission && a.vessel == b.vessel &&
         a.disturbance == b.disturbance && a.seed == b.seed;
}

// The scenario itself, or all in a folder: YAML files that aren't maps.
std::vector<std::string> scenarioFiles(const std::string& path) {
  if (!fs::is_directory(path)) {
    return {path};
  }
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(path)) {
    const std::string stem = entry.path().stem().string();
    const auto endsIn = [&](const std::string& tail) {
      return stem.size() > tail.size() && stem.substr(stem.size() - tail.size()) == tail;
    };
    if (entry.path().extension() == ".yaml" && !endsIn("_chart") && !endsIn("_world")) {
      files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

Result<scenario::MissionResult> sail(const Arguments& arguments,
                                     const simulation::LoopOptions& options,
                                     const scenario::Scenario& scenario,
                                     const simulation::Waters& waters,
                                     const scenario::MissionLabel& label) {
  const Result<scenario::Mission> task = scenario::missionOf(scenario, label.mission);
  if (!task) {
    return failure(task.error().message);
  }
  auto loop = simulation::ClosedLoop::create(options, waters, *task, arguments.seed);
  if (!loop) {
    return failure(loop.error().message);
  }
  std::optional<scenario::TrackWriter> track;
  std::string track_path;
  if (!arguments.tracks.empty()) {
    track_path =
        arguments.tracks + "/" + scenario.name + "_" + std::to_string(label.mission) + ".csv";
    auto opened = scenario::TrackWriter::open(track_path);
    if (!opened) {
      return failure(opened.error().message);
    }
    track = std::move(*opened);
  }
  otter_nav::ProgressLine line(std::cerr, isatty(STDERR_FILENO) != 0);
  scenario::MissionResult result =
      simulation::run(*loop, label, options.record_period_s, track ? &*track : nullptr,
                      [&](const scenario::Progress& progress) {
                        line.show(scenario::progressText(progress), progress.state, progress.t_s);
                      });
  line.finish();
  result.track = track_path;
  if (track) {
    if (const Status status = track->close(); !status) {
      return failure(status.error().message);
    }
  }
  return result;
}

void printHead() {
  std::printf("%-18s %3s %-9s %7s %7s %7s %7s %7s %7s %8s %8s %8s\n", "scenario", "no", "outcome",
              "time s", "way m", "clear m", "err m", "max m", "replans", "plan ms", "max ms",
              "track ms");
}

void printRow(const scenario::MissionResult& r) {
  std::printf("%-18s %3d %-9s %7.1f %7.1f %7.2f %7.3f %7.3f %7d %8.1f %8.1f %8.3f  %s\n",
              r.label.scenario.c_str(), r.label.mission, scenario::name(r.outcome), r.duration_s,
              r.distance_m, r.min_clearance_m, r.tracking_error_mean_m, r.tracking_error_max_m,
              r.replans, r.planning_ms_median, r.planning_ms_max, r.tracker_ms_p99,
              r.reason.c_str());
  std::fflush(stdout);
}

// All missions asked for; after each, --out holds all there is so far.
Result<std::vector<scenario::MissionResult>> sailAll(const Arguments& arguments) {
  const auto chosen = parseMissions(arguments.missions);
  if (!chosen) {
    return failure(chosen.error().message);
  }
  const auto options = simulation::loadLoopOptions(arguments.vessel, arguments.disturbance);
  if (!options) {
    return failure(options.error().message);
  }
  auto saved =
      arguments.resume ? loadResults(arguments.out) : std::vector<scenario::MissionResult>();
  if (!saved) {
    return failure(saved.error().message);
  }
  std::vector<scenario::MissionResult> results;
  printHead();
  for (const std::string& file : scenarioFiles(arguments.scenarios)) {
    const auto scenario = scenario::loadScenario(file);
    if (!scenario) {
      return failure(scenario.error().message);
    }
    auto waters = simulation::loadWaters(*scenario);
    if (!waters) {
      return failure(waters.error().message);
    }
    if (arguments.known) {
      waters->chart = waters->world;
    }
    for (const int index : arguments.missions.empty() ? defaultMissions(*scenario) : *chosen) {
      const scenario::MissionLabel label{scenario->name, index, arguments.vessel,
                                         arguments.disturbance, arguments.seed};
      const auto known =
          std::find_if(saved->begin(), saved->end(), [&](const scenario::MissionResult& result) {
            return arguments.resume && same(result.label, label);
          });
      if (known != saved->end()) {
        printRow(*known);
        results.push_back(*known);
        continue;
      }
      auto result = sail(arguments, *options, *scenario, *waters, label);
      if (!result) {
        return failure(result.error().message);
      }
      printRow(*result);
      results.push_back(*result);
      saved->push_back(std::move(*result));
      if (!arguments.out.empty()) {
        if (const Status status = scenario::saveJson(arguments.out, *saved); !status) {
          return failure(status.error().message);
        }
      }
    }
  }
  return results;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app{"Sails missions in the closed loop without ROS and prints a table"};
  app.add_option("--scenarios", arguments.scenarios, "scenario YAML, or a folder of them")
      ->required()
      ->check(CLI::ExistingPath);
  app.add_option("--missions", arguments.missions,
                 "numbers and ranges: 0,2,10-13 (default: each scenario's cross ones, or all)");
  app.add_option("--vessel", arguments.vessel, "name or YAML")->capture_default_str();
  app.add_option("--disturbance", arguments.disturbance, "preset")->capture_default_str();
  app.add_option("--seed", arguments.seed)->capture_default_str();
  CLI::Option* out =
      app.add_option("--out", arguments.out, "result JSON, whole after each mission");
  app.add_flag("--resume", arguments.resume, "keep what --out holds, sail what is missing there")
      ->needs(out);
  app.add_flag("--known", arguments.known, "the chart shows all that is there, to compare with");
  app.add_option("--tracks", arguments.tracks, "folder for the tracks' CSV")
      ->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);

  const auto results = sailAll(arguments);
  if (!results) {
    std::cerr << "mission_benchmark: " << results.error().message << '\n';
    return 2;
  }
  const auto arrived = std::count_if(
      results->begin(), results->end(),
      [](const scenario::MissionResult& r) { return r.outcome == scenario::Outcome::kArrived; });
  std::printf("%ld of %zu arrived\n", static_cast<long>(arrived), results->size());
  return arrived == static_cast<long>(results->size()) ? 0 : 1;
}
