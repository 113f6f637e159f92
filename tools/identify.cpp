// Fits a vessel's models to recorded motion and writes the vessel file and a report
// (docs/identification.md).
#include "otter_nav/identification/identify.hpp"

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "identify/bag_reader.hpp"
#include "identify/report.hpp"
#include "number_in.hpp"
#include "otter_nav/config/share.hpp"
#include "otter_nav/identification/csv.hpp"

namespace {

using otter_nav::failure;
using otter_nav::Result;
using otter_nav::Status;
namespace config = otter_nav::config;
namespace identification = otter_nav::identification;
namespace vessel = otter_nav::vessel;

struct Arguments {
  std::string bag;
  std::string csv;
  std::string odometry_topic = "odom";
  std::string command_topic = "thruster_command";
  std::string guess = "otter_textbook";
  std::string config = "config/identification.yaml";
  std::string name;
  std::string out;
  std::string report;
  std::string origin;
  std::vector<double> paper_speed_mps;
  bool current = false;
};

void declare(CLI::App& app, Arguments& a) {
  auto* input = app.add_option_group("input", "Where the recording is");
  input->add_option("--bag", a.bag, "rosbag with odometry and thruster commands");
  input->add_option("--csv", a.csv, "columns t,x,y,psi,u,v,r,f_left,f_right");
  input->require_option(1);
  app.add_option("--odom-topic", a.odometry_topic, "nav_msgs/Odometry in the bag")
      ->capture_default_str();
  app.add_option("--command-topic", a.command_topic, "otter_nav/ThrusterCommand in the bag")
      ->capture_default_str();
  app.add_option("--vessel-guess", a.guess,
                 "vessel file, or a name in config/vessels: thrusters, hull, start of the fit")
      ->capture_default_str();
  app.add_option("--config", a.config, "options of the fit")->capture_default_str();
  app.add_option("--name", a.name, "name of the vessel; default the guess's");
  app.add_option("--out", a.out, "vessel file to write")->required();
  app.add_option("--report", a.report, "directory for report and plots")->required();
  app.add_option("--paper-speed", a.paper_speed_mps,
                 "fit the paper's model to windows of this mean surge speed only, m/s: MIN MAX")
      ->expected(2)
      ->check(otter_nav::tools::numberIn(-100.0, 100.0));
  app.add_option("--origin", a.origin, "what the vessel file says it was found from");
  app.add_flag("--current", a.current, "estimate a steady current beside the parameters");
}

Result<identification::Options> loadOptions(const Arguments& a) {
  Result<identification::Options> options =
      config::findFile(a.config).and_then(config::load<identification::Options>);
  if (options && a.current) {
    options->problem.estimate_current = true;
  }
  if (options && !a.paper_speed_mps.empty()) {
    options->paper_speed_min_mps = a.paper_speed_mps[0];
    options->paper_speed_max_mps = a.paper_speed_mps[1];
  }
  return options;
}

Result<identification::Recording> loadRecording(const Arguments& a) {
  return a.bag.empty() ? identification::loadCsv(a.csv)
                       : otter_nav::ros_bridge::loadBag(a.bag, a.odometry_topic, a.command_topic);
}

Status writeVessel(const std::string& path, const std::string& text) {
  std::ofstream out(path);
  out << text;
  out.close();
  if (!out) {
    return failure(path + ": cannot be written");
  }
  return {};
}

Status run(const Arguments& a) {
  const Result<identification::Options> options = loadOptions(a);
  if (!options) {
    return failure(options.error().message);
  }
  Result<vessel::Parameters> guess = vessel::loadParameters(a.guess);
  if (!guess) {
    return failure(guess.error().message);
  }
  if (!a.name.empty()) {
    guess->name = a.name;
  }
  const Result<identification::Recording> recording = loadRecording(a);
  if (!recording) {
    return failure(recording.error().message);
  }
  const auto result = identification::identify(*recording, *guess, *options);
  if (!result) {
    return failure(result.error().message);
  }
  const std::string origin = !a.origin.empty() ? a.origin : a.bag.empty() ? a.csv : a.bag;
  const Status written = writeVessel(a.out, identification::vesselFileText(*result, origin));
  if (!written) {
    return written;
  }
  std::cout << identification::reportText(*result, origin);
  return identification::writeReport(*result, origin, a.report);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Fits a vessel's models to recorded motion.");
  Arguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  const Status status = run(arguments);
  if (!status) {
    std::cerr << "identify: " << status.error().message << '\n';
    return 1;
  }
  return 0;
}
