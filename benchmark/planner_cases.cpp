#include "planner_cases.hpp"

#include <time.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <utility>

#include "otter_nav/map/chart.hpp"
#include "planner_dump.hpp"
#include "shortest_way.hpp"

namespace otter_nav::benchmark {
namespace {

namespace fs = std::filesystem;

struct Method {
  std::string name;
  planner::Planner planner;
};

// One scenario with its field: what all its missions share.
struct Ground {
  scenario::Scenario scenario;
  map::DistanceField field;
  double field_ms = 0.0;
};

Result<Ground> loadGround(const std::string& file, const std::string& which) {
  auto scenario = scenario::loadScenario(file);
  if (!scenario) {
    return failure(scenario.error().message);
  }
  const auto grid = map::loadChart(which == "world" ? scenario->world_path : scenario->chart_path);
  if (!grid) {
    return failure(grid.error().message);
  }
  Ground ground;
  const auto began = std::chrono::steady_clock::now();
  ground.field = map::DistanceField(*grid, map::DistanceFieldOptions{});
  ground.field_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  ground.scenario = std::move(*scenario);
  return ground;
}

// This thread's processor time from now on.
planner::Termination cpuClock(double budget_s) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  planner::Termination termination = planner::wallClock(budget_s);
  termination.elapsed_s = [now, began = now()] { return now() - began; };
  return termination;
}

planner::Query queryOf(const scenario::Mission& mission, const vessel::Parameters& vessel,
                       std::uint64_t seed) {
  planner::Query query;
  query.start.flat.position = mission.start.position;
  query.start.psi_rad = mission.start.psi_rad;
  query.goal.flat.position = mission.goal.position;
  query.goal.psi_rad = mission.goal.psi_rad;
  query.limits = feasibility::SafetyLimits::of(vessel);
  query.seed = seed;
  return query;
}

class Runner {
 public:
  Runner(const Request& request, vessel::Parameters vessel, std::vector<Method> methods)
      : request_(request), vessel_(std::move(vessel)), methods_(std::move(methods)) {}

  Status runMission(const Ground& ground, int index, double shortest_m, Outcome& outcome,
                    const std::function<void()>& done) {
    const auto& mission = ground.scenario.missions[static_cast<std::size_t>(index)];
    for (int seed = 1; seed <= request_.seeds; ++seed) {
      for (Method& method : methods_) {
        Case result;
        result.scenario = ground.scenario.name;
        result.mission = index;
        result.kind = mission.kind;
        result.seed = static_cast<std::uint64_t>(seed);
        result.method = method.name;
        result.shortest_m = shortest_m;
        auto status = runCase(ground, mission, method, result);
        if (!status) {
          return status;
        }
        outcome.cases.push_back(std::move(result));
        done();
      }
    }
    return {};
  }

 private:
  Status runCase(const Ground& ground, const scenario::Mission& mission, Method& method,
                 Case& result) {
    const auto termination = [&] {
      const double budget_s = 1e-3 * request_.budget_ms;
      return request_.clock == "cpu" ? cpuClock(budget_s) : planner::wallClock(budget_s);
    };
    planner::Query query =
        underLoad(queryOf(mission, vessel_, result.seed), request_.load, vessel_, ground.field);
    planner::Plan plan = method.planner.plan(ground.field, query, termination());
    if (request_.under_way.at_share > 0.0 && plan.outcome == planner::Outcome::kSolved) {
      query = underWay(query, plan.trajectory, request_.under_way, vessel_);
      plan = method.planner.plan(ground.field, query, termination());
    }
    result.success = plan.outcome == planner::Outcome::kSolved;
    result.reason =
        result.success ? "" : std::string(planner::toString(plan.outcome)) + ": " + plan.reason;
    result.figures = plan.figures;
    if (request_.dump.empty() || plan.trajectory.empty()) {
      return {};
    }
    result.dump =
        (fs::path(request_.dump) / (result.scenario + "_" + std::to_string(result.mission) + "_" +
                                    method.name + "_" + std::to_string(result.seed) + ".csv"))
            .string();
    return dumpTrajectory(plan.trajectory, vessel_, result.dump);
  }

  const Request& request_;
  vessel::Parameters vessel_;
  std::vector<Method> methods_;
};

Result<std::vector<Method>> makeMethods(const Request& request, const vessel::Parameters& vessel) {
  const auto shipped = planner::loadOptions(request.config);
  if (!shipped) {
    return failure(shipped.error().message);
  }
  std::vector<Method> methods;
  for (const std::string& name : request.methods) {
    const auto options = methodOptions(*shipped, name);
    if (!options) {
      return failure(options.error().message);
    }
    methods.push_back({name, planner::Planner(*options, vessel)});
  }
  return methods;
}

bool wanted(const Request& request, const scenario::Mission& mission) {
  return request.kind == "all" || request.kind == mission.kind;
}

}  // namespace

Result<planner::Options> methodOptions(const planner::Options& shipped, const std::string& method) {
  static const std::map<std::string, std::pair<bool, bool>> kSwitches = {
      {"baseline", {false, false}},
      {"local", {true, false}},
      {"global", {false, true}},
      {"proposed", {true, true}}};
  const auto found = kSwitches.find(method);
  if (found == kSwitches.end()) {
    return failure("no method '" + method + "': one of baseline, local, global, proposed");
  }
  planner::Options options = shipped;
  options.local_optimization = found->second.first;
  options.global_optimization = found->second.second;
  return options;
}

Result<Outcome> runCases(const Request& request, const std::function<void(int, int)>& progress) {
  const auto files = scenario::scenarioFiles(request.scenarios);
  const auto vessel = vessel::loadParameters(request.vessel);
  if (!files || !vessel) {
    return failure(files ? vessel.error().message : files.error().message);
  }
  auto methods = makeMethods(request, *vessel);
  if (!methods) {
    return failure(methods.error().message);
  }
  const ShortestWays shortest(request.scenarios, request.map == "world");
  Outcome outcome;
  outcome.vessel = vessel->name;
  std::vector<Ground> grounds;
  int all = 0;
  for (const std::string& file : *files) {
    auto ground = loadGround(file, request.map);
    if (!ground) {
      return failure(ground.error().message);
    }
    for (const auto& mission : ground->scenario.missions) {
      all += wanted(request, mission) ? request.seeds * static_cast<int>(methods->size()) : 0;
    }
    outcome.field_ms.push_back(ground->field_ms);
    grounds.push_back(std::move(*ground));
  }
  Runner runner(request, *vessel, std::move(*methods));
  int done = 0;
  for (const Ground& ground : grounds) {
    for (std::size_t i = 0; i < ground.scenario.missions.size(); ++i) {
      const auto& mission = ground.scenario.missions[i];
      if (!wanted(request, mission)) {
        continue;
      }
      const double shortest_m =
          shortest.find(ground.scenario.name, static_cast<int>(i), ground.field,
                        mission.start.position, mission.goal.position);
      const auto status = runner.runMission(ground, static_cast<int>(i), shortest_m, outcome,
                                            [&] { progress(++done, all); });
      if (!status) {
        return failure(status.error().message);
      }
    }
  }
  return outcome;
}

}  // namespace otter_nav::benchmark
