// The paper's table I on a folder of scenarios: plans every mission with every method and seed,
// prints the table, and writes the cases as JSON and the trajectories as CSV. Needs no ROS master.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "otter_nav/base/progress_line.hpp"
#include "otter_nav/config/share.hpp"
#include "planner_cases.hpp"
#include "planner_report.hpp"

namespace {

using otter_nav::benchmark::Request;

template <typename Pair>
void addPair(CLI::App& app, const std::string& name, Pair& pair, const std::string& what) {
  app.add_option_function<std::vector<double>>(
         name,
         [&pair](const std::vector<double>& given) { pair = Eigen::Vector2d(given[0], given[1]); },
         what)
      ->delimiter(',')
      ->expected(2)
      ->type_name("EAST,NORTH");
}

void addLoad(CLI::App& app, otter_nav::benchmark::Load& load) {
  addPair(app, "--force", load.disturbance.force_n, "plan against this force, N");
  addPair(app, "--current", load.disturbance.current_mps, "plan in this current, m/s");
  app.add_option("--beside", load.beside_m, "room beside the hull, m (default: 0.26)")
      ->check(CLI::Range(0.0, 100.0));
  app.add_option("--thrust-share", load.thrust_share, "of the thrust that plans take (default: 1)")
      ->check(CLI::Range(0.1, 1.0));
  app.add_option("--hull-margin", load.hull_margin_m, "around the hull, m (default: 0)")
      ->check(CLI::Range(0.0, 100.0));
}

void addUnderWay(CLI::App& app, otter_nav::benchmark::UnderWay& change) {
  app.add_option("--under-way", change.at_share,
                 "plan again from this share of each plan's duration (default: from rest alone)")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--then-speed", change.speed_max_mps, "likewise, no faster than this, m/s")
      ->check(CLI::Range(0.01, 100.0));
  addPair(app, "--then-force", change.force_n, "likewise, against this force, N");
  addPair(app, "--then-current", change.current_mps, "likewise, in this current, m/s");
}

void addOptions(CLI::App& app, Request& request, std::string& out, bool& profile, bool& refused) {
  app.add_option("--scenarios", request.scenarios, "folder of scenario files")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("--map", request.map, "plan on the world or on the chart")
      ->check(CLI::IsMember({"world", "chart"}))
      ->capture_default_str();
  app.add_option("--kind", request.kind, "missions to plan")
      ->check(CLI::IsMember({"local", "cross", "all"}))
      ->capture_default_str();
  app.add_option("--seeds", request.seeds, "seeds 1 to N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--budget-ms", request.budget_ms, "time for one query")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
  app.add_option("--clock", request.clock, "times by the wall's clock or the processor's")
      ->check(CLI::IsMember({"wall", "cpu"}))
      ->capture_default_str();
  app.add_option("--methods", request.methods, "comma-separated: baseline,local,global,proposed")
      ->delimiter(',')
      ->check(CLI::IsMember({"baseline", "local", "global", "proposed"}))
      ->capture_default_str();
  app.add_option("--vessel", request.vessel, "name in config/vessels or a YAML file")
      ->capture_default_str();
  app.add_option("--config", request.config,
                 "folder of planner.yaml and topology.yaml (default: the package's)");
  addLoad(app, request.load);
  addUnderWay(app, request.under_way);
  app.add_option("--out", out, "JSON file to write");
  app.add_option("--dump", request.dump, "folder for trajectories, one CSV a case");
  app.add_flag("--profile", profile, "print where the time went");
  app.add_flag("--refused", refused, "print why each case failed");
}

int fail(const std::string& message) {
  std::cerr << "planner_benchmark: " << message << "\n";
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  std::string out;
  bool profile = false;
  bool refused = false;
  CLI::App app("Plans every mission of a folder of scenarios and prints the paper's table I.");
  addOptions(app, request, out, profile, refused);
  CLI11_PARSE(app, argc, argv);
  if (request.config.empty()) {
    const auto share = otter_nav::config::shareDirectory();
    if (!share) {
      return fail(share.error().message);
    }
    request.config = *share + "/config";
  }
  // Tried before the work; what is there stays until there is something in its place.
  if (!out.empty() && !std::ofstream(out, std::ios::app)) {
    return fail("--out: can't write " + out);
  }
  otter_nav::ProgressLine bar(std::cerr, isatty(STDERR_FILENO) != 0);
  const auto outcome =
      otter_nav::benchmark::runCases(request, [&bar](int done, int all) { bar.show(done, all); });
  if (!outcome) {
    return fail(outcome.error().message);
  }
  otter_nav::benchmark::printTable(*outcome, request, profile, std::cout);
  if (refused) {
    otter_nav::benchmark::printRefused(*outcome, std::cout);
  }
  if (out.empty()) {
    return 0;
  }
  std::ofstream json(out);
  json << otter_nav::benchmark::toJson(*outcome, request).dump(1) << "\n";
  json.close();
  return json ? 0 : fail("--out: writing " + out + " failed");
}
