// Sails missions of scenarios in the closed loop without ROS and prints what came of them.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/base/progress_line.hpp"
#include "otter_nav/simulation/closed_loop.hpp"
#include "otter_nav/simulation/monitor.hpp"

namespace {

namespace fs = std::filesystem;
namespace scenario = otter_nav::scenario;
namespace simulation = otter_nav::simulation;
using otter_nav::failure;
using otter_nav::firstFailure;
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
  bool monitor = false;
  int jobs = 1;
  std::string shard;
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
        scenario::Outcome::kCapsized, scenario::Outcome::kTimeout, scenario::Outcome::kError}) {
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
  result.replans_for_weather = json.at("replans_for_weather");
  result.planning_ms_median = number("planning_ms_median");
  result.planning_ms_max = number("planning_ms_max");
  result.tracker_ms_p99 = number("tracker_ms_p99");
  result.track = json.at("track");
  result.vessels = json.value("vessels", "");
  if (const auto monitor = json.find("monitor"); monitor != json.end()) {
    result.monitored = {monitor->at("steps"), monitor->at("violations"), monitor->at("margin_m"),
                        monitor->at("first")};
  }
  return result;
}

// What a campaign that was stopped has left; nothing if it had not come to its first result.
Result<std::vector<scenario::MissionResult>> loadResults(const std::string& path) {
  std::vector<scenario::MissionResult> results;
  if (!fs::exists(path)) {
    return results;
  }
  if (!fs::is_regular_file(path)) {
    return failure("--resume: " + path + " is no file");
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

// "I/M": of every M missions the I-th, I from 1 on.
struct Shard {
  int number = 1;
  int count = 1;
};
Result<Shard> parseShard(const std::string& text) {
  Shard shard;
  char rest = 0;
  const bool read = std::sscanf(text.c_str(), "%d/%d%c", &shard.number, &shard.count, &rest) == 2;
  if (!text.empty() && (!read || shard.number < 1 || shard.number > shard.count)) {
    return failure("--shard: '" + text + "' is not I/M with 1 <= I <= M");
  }
  return shard;
}

// A CSV beside the others, named after the mission.
std::string csvPath(const Arguments& arguments, const scenario::MissionLabel& label,
                    const std::string& ending) {
  return arguments.tracks + "/" + label.scenario + "_" + std::to_string(label.mission) + ending;
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
  std::string track_path;
  std::string vessels_path;
  std::optional<scenario::TableWriter> track;
  std::optional<scenario::TableWriter> vessels;
  const auto open = [](const std::string& path, const char* columns,
                       std::optional<scenario::TableWriter>& writer) -> Status {
    return scenario::TableWriter::open(path, columns).map([&](scenario::TableWriter opened) {
      writer = std::move(opened);
    });
  };
  if (!arguments.tracks.empty()) {
    track_path = csvPath(arguments, label, ".csv");
    Status opened = open(track_path, scenario::kTrackColumns, track);
    if (opened && !scenario.vessels.empty()) {
      vessels_path = csvPath(arguments, label, "_vessels.csv");
      opened = open(vessels_path, scenario::kVesselsColumns, vessels);
    }
    if (!opened) {
      return failure(opened.error().message);
    }
  }
  otter_nav::ProgressLine line(std::cerr, isatty(STDERR_FILENO) != 0);
  std::function<void(const scenario::Progress&)> progress;
  if (arguments.jobs == 1) {
    progress = [&](const scenario::Progress& now) {
      line.show(scenario::progressText(now), now.state, now.t_s);
    };
  }
  std::optional<simulation::Monitor> monitor;
  if (arguments.monitor) {
    monitor.emplace(waters, options);
  }
  scenario::MissionResult result =
      simulation::run(*loop, label, options.record_period_s, track ? &*track : nullptr, progress,
                      vessels ? &*vessels : nullptr, monitor ? &*monitor : nullptr);
  line.finish();
  result.track = track_path;
  result.vessels = vessels_path;
  const Status closed =
      firstFailure(track ? track->close() : Status(), vessels ? vessels->close() : Status());
  if (!closed) {
    return failure(closed.error().message);
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
  if (r.monitored) {
    std::printf("%18s     %ld steps, margin %.3f m, %ld violations%s%s\n",
                "monitor:", r.monitored->steps, r.monitored->margin_m, r.monitored->violations,
                r.monitored->first.empty() ? "" : ", the first at ", r.monitored->first.c_str());
  }
  std::fflush(stdout);
}

// The missions that are asked for, in their order.
struct Task {
  std::shared_ptr<const scenario::Scenario> scenario;
  scenario::MissionLabel label;
};
Result<std::vector<Task>> tasksOf(const Arguments& arguments) {
  const auto chosen = parseMissions(arguments.missions);
  const auto shard = parseShard(arguments.shard);
  const auto files = scenario::scenarioFiles(arguments.scenarios);
  if (const Status status = firstFailure(chosen, shard, files); !status) {
    return failure(status.error().message);
  }
  std::vector<Task> tasks;
  int count = 0;
  for (const std::string& file : *files) {
    auto loaded = scenario::loadScenario(file);
    if (!loaded) {
      return failure(loaded.error().message);
    }
    const auto shared = std::make_shared<const scenario::Scenario>(std::move(*loaded));
    for (const int index : arguments.missions.empty() ? defaultMissions(*shared) : *chosen) {
      if (count++ % shard->count == shard->number - 1) {
        tasks.push_back(
            {shared,
             {shared->name, index, arguments.vessel, arguments.disturbance, arguments.seed}});
      }
    }
  }
  return tasks;
}

// Sails tasks on as many threads as are asked for; whatever is done is in the file.
class Campaign {
 public:
  Campaign(const Arguments& arguments, const simulation::LoopOptions& options,
           std::vector<Task> tasks, const std::vector<scenario::MissionResult>& saved)
      : arguments_(arguments), options_(options), tasks_(std::move(tasks)), done_(tasks_.size()) {
    for (const scenario::MissionResult& result : saved) {
      const auto task = std::find_if(tasks_.begin(), tasks_.end(), [&](const Task& candidate) {
        return same(candidate.label, result.label);
      });
      if (task == tasks_.end()) {
        others_.push_back(result);
      } else {
        done_[static_cast<std::size_t>(task - tasks_.begin())] = result;
      }
    }
  }

  Status sailAll() {
    for (const auto& result : done_) {
      if (result) {
        printRow(*result);
      }
    }
    std::vector<std::thread> threads;
    for (int k = 1; k < arguments_.jobs; ++k) {
      threads.emplace_back([this] { work(); });
    }
    work();
    for (std::thread& thread : threads) {
      thread.join();
    }
    return status_;
  }
  // Of the tasks; all of them if sailAll() succeeded.
  [[nodiscard]] std::vector<scenario::MissionResult> results() const { return gathered({}); }

 private:
  void work() {
    // Tasks of one scenario follow each other: its waters are loaded once.
    std::shared_ptr<const scenario::Scenario> loaded;
    simulation::Waters waters;
    for (std::size_t k = next_++; k < tasks_.size(); k = next_++) {
      const Task& task = tasks_[k];
      if (done_[k]) {
        continue;
      }
      if (loaded != task.scenario) {
        auto read = simulation::loadWaters(*task.scenario);
        if (!read) {
          return fail(read.error().message);
        }
        waters = std::move(*read);
        if (arguments_.known) {
          waters.chart = waters.world;
        }
        loaded = task.scenario;
      }
      auto result = sail(arguments_, options_, *task.scenario, waters, task.label);
      if (!result) {
        return fail(result.error().message);
      }
      if (!take(k, std::move(*result))) {
        return;
      }
    }
  }
  void fail(const std::string& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    status_ = failure(message);
    next_ = tasks_.size();
  }
  bool take(std::size_t k, scenario::MissionResult result) {
    const std::lock_guard<std::mutex> lock(mutex_);
    printRow(result);
    done_[k] = std::move(result);
    if (!arguments_.out.empty() && status_) {
      status_ = scenario::saveJson(arguments_.out, gathered(others_));
    }
    return status_.has_value();
  }
  // What there is, in the tasks' order.
  [[nodiscard]] std::vector<scenario::MissionResult> gathered(
      std::vector<scenario::MissionResult> before) const {
    for (const auto& result : done_) {
      if (result) {
        before.push_back(*result);
      }
    }
    return before;
  }

  const Arguments& arguments_;
  const simulation::LoopOptions& options_;
  std::vector<Task> tasks_;
  std::vector<scenario::MissionResult> others_;  // in the file already, and not asked for
  std::mutex mutex_;
  std::vector<std::optional<scenario::MissionResult>> done_;
  Status status_;
  std::atomic<std::size_t> next_{0};
};

// All missions asked for; after each, --out holds all there is so far.
Result<std::vector<scenario::MissionResult>> sailAll(const Arguments& arguments) {
  auto tasks = tasksOf(arguments);
  const auto options = simulation::loadLoopOptions(arguments.vessel, arguments.disturbance);
  const auto saved = arguments.resume ? loadResults(arguments.out)
                                      : Result<std::vector<scenario::MissionResult>>();
  if (const Status status = firstFailure(tasks, options, saved); !status) {
    return failure(status.error().message);
  }
  printHead();
  Campaign campaign(arguments, *options, std::move(*tasks), *saved);
  if (const Status status = campaign.sailAll(); !status) {
    return failure(status.error().message);
  }
  return campaign.results();
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
  app.add_option("--tracks", arguments.tracks,
                 "folder for the CSV of each mission's track and other vessels")
      ->check(CLI::ExistingDirectory);
  app.add_option("--jobs", arguments.jobs, "missions at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--shard", arguments.shard, "I/M: only each M-th mission, from the I-th on");
  app.add_flag("--known", arguments.known, "the chart shows the world, for comparison");
  app.add_flag("--monitor", arguments.monitor,
               "check each step by the world: the hull's margin, and the stop that must exist");
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
  long steps = 0;
  long violations = 0;
  for (const scenario::MissionResult& r : *results) {
    steps += r.monitored ? r.monitored->steps : 0;
    violations += r.monitored ? r.monitored->violations : 0;
  }
  if (arguments.monitor) {
    std::printf("%ld violations in %ld steps\n", violations, steps);
  }
  if (violations > 0) {
    return 3;
  }
  return arrived == static_cast<long>(results->size()) ? 0 : 1;
}
