// Runs the propeller speeds of a recorded file through a plant, and says how far the motion is from
// the recorded one. Needs no ROS.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <fstream>

#include "number_in.hpp"
#include "replay/replay.hpp"
#include "written_over.hpp"

namespace {

using namespace otter_nav;

struct Arguments {
  std::string vessel;
  plant::Options options;
  std::string input;
  std::string output;
  plant::SteadyCurrent current;
  double step_s = 0.01;
  bool no_lag = false;
};

void declare(CLI::App& app, Arguments& a, std::vector<double>& position) {
  app.add_option("--vessel", a.vessel, "NAME of config/vessels or a YAML file")->required();
  app.add_option("--input", a.input, "CSV with t, n_left, n_right and perhaps the motion")
      ->required();
  app.add_option("--output", a.output, "CSV of the motion computed")->required();
  app.add_option("--payload", a.options.payload.mass_kg, "kg, of otter")
      ->check(tools::numberIn(0.0, 45.0))
      ->capture_default_str();
  app.add_option("--payload-position", position, "forward, starboard, down of midships, m")
      ->expected(3)
      ->check(tools::numberIn(-1.0, 1.0));
  app.add_option("--current-speed", a.current.speed_mps, "m/s")->check(tools::numberIn(0.0, 5.0));
  app.add_option("--current-direction", a.current.direction_rad,
                 "towards, rad clockwise from north")
      ->check(tools::numberIn(-100.0, 100.0));
  app.add_option("--step", a.step_s, "longest integration step, s")
      ->check(tools::numberIn(1e-4, 0.05))
      ->capture_default_str();
  app.add_flag("--no-lag", a.no_lag, "propellers take up a speed at once");
}

Result<plant::Recording> run(Arguments a) {
  if (const Status status = tools::notOver(a.input, a.output); !status) {
    return failure(status.error().message);
  }
  Result<vessel::Parameters> vessel = vessel::loadParameters(a.vessel);
  if (!vessel) {
    return failure(vessel.error().message);
  }
  a.options.vessel = *std::move(vessel);
  Result<plant::Recording> input = plant::readRecording(a.input);
  if (!input) {
    return input;
  }
  const Result<std::unique_ptr<plant::PlantModel>> model = plant::makePlantModel(a.options);
  if (!model) {
    return failure(model.error().message);
  }
  const plant::Recording result = plant::replay(**model, *input, a.current, a.step_s);
  std::ofstream out(a.output);
  plant::writeRecording(out, result);
  out.close();
  if (!out) {
    return failure(a.output + ": cannot be written");
  }
  std::printf("%zu rows, %.2f s replayed into %s\n", result.rows.size(),
              result.rows.back().time_s - result.rows.front().time_s, a.output.c_str());
  if (input->has_motion) {
    const plant::ReplayDifference worst = plant::worstDifference(result, *input);
    std::printf("worst position difference %.3e m (at %.2f s)\n", worst.position_m,
                worst.position_time_s);
    std::printf("worst heading difference %.3e rad (at %.2f s)\n", worst.heading_rad,
                worst.heading_time_s);
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Replays recorded propeller speeds on a plant model");
  Arguments arguments;
  std::vector<double> position;
  declare(app, arguments, position);
  CLI11_PARSE(app, argc, argv);
  arguments.options.propeller_lag = !arguments.no_lag;
  if (!position.empty()) {
    arguments.options.payload.position_m = {position[0], position[1], position[2]};
  }
  if (const Result<plant::Recording> result = run(arguments); !result) {
    std::fprintf(stderr, "plant_replay: %s\n", result.error().message.c_str());
    return 1;
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "plant_replay: %s\n", e.what());
  return 1;
}
