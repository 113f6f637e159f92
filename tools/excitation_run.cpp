// Sails the excitation manoeuvres on the plant, without ROS, and writes what identify reads.
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <string>

#include "number_in.hpp"
#include "otter_nav/config/share.hpp"
#include "otter_nav/identification/csv.hpp"
#include "otter_nav/identification/manoeuvres.hpp"
#include "otter_nav/plant/simulator.hpp"

namespace {

using otter_nav::failure;
using otter_nav::Result;
using otter_nav::Status;
using otter_nav::tools::numberIn;
namespace config = otter_nav::config;
namespace identification = otter_nav::identification;
namespace plant = otter_nav::plant;
namespace vessel = otter_nav::vessel;

struct Arguments {
  std::string vessel = "otter";
  std::string plant = "config/plant.yaml";
  std::string disturbance = "config/disturbances/none.yaml";
  std::string excitation = "config/excitation.yaml";
  std::string out;
  double period_s = 0.01;
  double position_noise_m = 0.0;
  double heading_noise_rad = 0.0;
  double velocity_noise_mps = 0.0;
  double yaw_rate_noise_radps = 0.0;
  int seed = 1;
};

void declare(CLI::App& app, Arguments& a) {
  app.add_option("--vessel", a.vessel, "NAME of config/vessels or a YAML file")
      ->capture_default_str();
  app.add_option("--plant", a.plant, "options of the plant")->capture_default_str();
  app.add_option("--disturbance", a.disturbance, "preset file")->capture_default_str();
  app.add_option("--excitation", a.excitation, "list of manoeuvres")->capture_default_str();
  app.add_option("--period", a.period_s, "of control and record, s")
      ->check(numberIn(0.001, 0.5))
      ->capture_default_str();
  app.add_option("--position-noise", a.position_noise_m, "m")
      ->check(numberIn(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--heading-noise", a.heading_noise_rad, "rad")
      ->check(numberIn(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--velocity-noise", a.velocity_noise_mps, "m/s")
      ->check(numberIn(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--yaw-rate-noise", a.yaw_rate_noise_radps, "rad/s")
      ->check(numberIn(0.0, 10.0))
      ->capture_default_str();
  app.add_option("--seed", a.seed, "of noise and disturbances")->capture_default_str();
  app.add_option("--out", a.out, "CSV to write")->required();
}

Result<plant::Simulator> makeSimulator(const Arguments& a) {
  const Result<std::string> plant_file = config::findFile(a.plant);
  if (!plant_file) {
    return failure(plant_file.error().message);
  }
  const Result<vessel::Parameters> vessel = vessel::loadParameters(a.vessel);
  if (!vessel) {
    return failure(vessel.error().message);
  }
  Result<plant::Options> options = plant::loadOptions(*vessel, *plant_file, a.disturbance);
  if (!options) {
    return failure(options.error().message);
  }
  options->odometry.position_noise_m = a.position_noise_m;
  options->odometry.heading_noise_rad = a.heading_noise_rad;
  options->odometry.velocity_noise_mps = a.velocity_noise_mps;
  options->odometry.yaw_rate_noise_radps = a.yaw_rate_noise_radps;
  return plant::Simulator::create(*options, otter_nav::map::OccupancyGrid{},
                                  static_cast<std::uint64_t>(a.seed));
}

Result<identification::Excitation> makeExcitation(const Arguments& a,
                                                  const plant::Simulator& simulator) {
  const Result<YAML::Node> node = config::findFile(a.excitation).and_then(config::loadFile);
  if (!node) {
    return failure(node.error().message);
  }
  auto manoeuvres = identification::readExcitation(config::Section(*node, a.excitation));
  if (!manoeuvres) {
    return failure(manoeuvres.error().message);
  }
  const Eigen::Vector2d limits = simulator.thrustLimits();
  vessel::Thrusters thrusters;
  thrusters.ahead_max_n = limits[0];
  thrusters.astern_max_n = limits[1];
  return identification::Excitation(*std::move(manoeuvres), thrusters);
}

Status run(const Arguments& a) {
  Result<plant::Simulator> simulator = makeSimulator(a);
  if (!simulator) {
    return failure(simulator.error().message);
  }
  Result<identification::Excitation> excitation = makeExcitation(a, *simulator);
  if (!excitation) {
    return failure(excitation.error().message);
  }
  std::ofstream out(a.out);
  identification::writeCsvHeader(out);
  while (!excitation->finished()) {
    const vessel::State state = simulator->odometry().state;
    const vessel::Thrusts thrusts = excitation->step(simulator->time(), state);
    identification::writeCsvRow(out, simulator->time(), state, thrusts);
    simulator->step(thrusts, a.period_s);
  }
  out.close();
  if (!out) {
    return failure(a.out + ": cannot be written");
  }
  std::cout << a.out << ": " << simulator->time() << " s of " << a.vessel << '\n';
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Sails the excitation manoeuvres on the plant and writes a CSV for identify.");
  Arguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  const Status status = run(arguments);
  if (!status) {
    std::cerr << "excitation_run: " << status.error().message << '\n';
    return 1;
  }
  return 0;
}
