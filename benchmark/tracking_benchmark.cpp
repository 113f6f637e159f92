// Closed loop of tracker and plant on a figure of eight, a spiral or a file's trajectory, printed
// beside the paper's Table II.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "otter_nav/base/progress_line.hpp"
#include "otter_nav/config/share.hpp"
#include "tracking/closed_loop.hpp"
#include "tracking/paths.hpp"

namespace {

using namespace otter_nav;

struct Arguments {
  std::string vessel = "otter_gazebo";
  std::string path = "eight";
  std::string disturbance = "none";
  std::string method = "flatness";
  std::string estimator = "on";
  std::string config = "config/tracker.yaml";
  std::string out;
  std::string dump;
  double top_speed_mps = 0.0;
  double noise = 0.0;
  std::uint64_t seed = 1;
  bool quiet = false;
};

// What the thrust leaves room for under each disturbance.
double defaultTopSpeed(const Arguments& a) {
  if (a.vessel.find("gazebo") != std::string::npos) {
    return a.disturbance == "hard" ? 1.5 : a.disturbance == "paper" ? 3.6 : 4.3;
  }
  return a.disturbance == "hard" ? 2.0 : 2.5;
}

Result<trajectory::Trajectory> buildPath(const Arguments& a) {
  if (a.path == "eight") {
    return benchmark::eight(a.top_speed_mps);
  }
  if (a.path == "spiral") {
    return benchmark::spiral(a.top_speed_mps);
  }
  return benchmark::fromCsv(a.path);
}

Result<benchmark::RunSetup> buildSetup(const Arguments& a) {
  benchmark::RunSetup setup;
  const auto vessel = vessel::loadParameters(a.vessel);
  if (!vessel) {
    return failure(vessel.error().message);
  }
  const auto tracker_file = config::findFile(a.config);
  const auto plant_file = config::findFile("config/plant.yaml");
  for (const auto* file : {&tracker_file, &plant_file}) {
    if (!*file) {
      return failure(file->error().message);
    }
  }
  const auto options = config::load<tracker::Options>(*tracker_file);
  if (!options) {
    return failure(options.error().message);
  }
  const auto plant = plant::loadOptions(*vessel, *plant_file, a.disturbance);
  if (!plant) {
    return failure(plant.error().message);
  }
  auto path = buildPath(a);
  if (!path) {
    return failure(path.error().message);
  }
  // Eight and spiral end under way; the last seconds are the horizon's.
  const bool under_way = a.path == "eight" || a.path == "spiral";
  setup.duration_s = path->duration() - (under_way ? benchmark::kRunOutS : 0.0);
  if (setup.duration_s < setup.errors_from_s + 1.0) {
    return failure(a.path + ": lasts " + std::to_string(setup.duration_s) + " s, at least " +
                   std::to_string(setup.errors_from_s + 1.0) + " are needed (errors count from " +
                   std::to_string(setup.errors_from_s) + " s on)");
  }
  setup.trajectory = std::move(*path);
  setup.vessel = *vessel;
  setup.tracker = *options;
  setup.tracker.method = a.method == "plain" ? tracker::Method::kPlain : tracker::Method::kFlatness;
  setup.tracker.estimator.enabled = a.estimator == "on";
  setup.plant = *plant;
  setup.plant.odometry.position_noise_m = 0.02 * a.noise;
  setup.plant.odometry.heading_noise_rad = 0.005 * a.noise;
  setup.plant.odometry.velocity_noise_mps = 0.02 * a.noise;
  setup.plant.odometry.yaw_rate_noise_radps = 0.01 * a.noise;
  setup.seed = a.seed;
  return setup;
}

nlohmann::json toJson(const Arguments& a, const benchmark::RunFigures& f) {
  nlohmann::json capsized_at_s;
  if (f.capsized_at_s >= 0.0) {
    capsized_at_s = f.capsized_at_s;
  }
  return {{"vessel", a.vessel},
          {"path", a.path},
          {"disturbance", a.disturbance},
          {"method", a.method},
          {"estimator", a.estimator},
          {"seed", a.seed},
          {"top_speed", a.top_speed_mps},
          {"mean_error_m", f.mean_error_m},
          {"max_error_m", f.max_error_m},
          {"mean_speed", f.mean_speed},
          {"max_speed", f.max_speed},
          {"planned_mean_speed", f.planned_mean_speed},
          {"yaw_rate_integral", f.yaw_rate_integral},
          {"thrust_rms_n", f.thrust_rms_n},
          {"thrust_rate_rms_nps", f.thrust_rate_rms_nps},
          {"saturation_share", f.saturation_share},
          {"unsolved_share", f.unsolved_share},
          {"capsized_at_s", capsized_at_s},
          {"solver_us",
           {{"median", f.step_us.median}, {"p99", f.step_us.p99}, {"max", f.step_us.max}}}};
}

void printTable(const Arguments& a, const benchmark::RunFigures& f) {
  std::printf("%s, %s at up to %.1f m/s, disturbance %s, estimator %s, seed %llu\n",
              a.vessel.c_str(), a.path.c_str(), a.top_speed_mps, a.disturbance.c_str(),
              a.estimator.c_str(), static_cast<unsigned long long>(a.seed));
  std::printf("%-22s %10s %10s %10s %10s %12s\n", "Table II", "mean err", "max err", "mean vel",
              "max vel", "int r^2 dt");
  std::printf("%-22s %9.3fm %9.3fm %7.2fm/s %7.2fm/s %7.2frad2/s\n", "paper, without DF", 0.257,
              0.768, 2.93, 4.31, 2.01);
  std::printf("%-22s %9.3fm %9.3fm %7.2fm/s %7.2fm/s %7.2frad2/s\n", "paper, with DF", 0.121, 0.483,
              3.32, 4.37, 0.95);
  std::printf("%-22s %9.3fm %9.3fm %7.2fm/s %7.2fm/s %7.2frad2/s\n",
              a.method == "plain" ? "ours, plain" : "ours, flatness", f.mean_error_m, f.max_error_m,
              f.mean_speed, f.max_speed, f.yaw_rate_integral);
  std::printf("thrust rms %.1f N, its rate %.1f N/s; saturated %.1f %%, unsolved %.2f %%\n",
              f.thrust_rms_n, f.thrust_rate_rms_nps, 100 * f.saturation_share,
              100 * f.unsolved_share);
  std::printf(
      "mean speed planned %.2f m/s; control step median %.1f us, 99 %% %.1f us, max %.1f us\n",
      f.planned_mean_speed, f.step_us.median, f.step_us.p99, f.step_us.max);
}

// Exit code of a run that ended so; other errors have 1.
constexpr int kCapsizedExit = 2;

int fail(const std::string& message) {
  std::cerr << "tracking_benchmark: " << message << "\n";
  return 1;
}

int runOnce(const Arguments& a) {
  const auto setup = buildSetup(a);
  if (!setup) {
    return fail(setup.error().message);
  }
  std::ofstream dump;
  if (!a.dump.empty()) {
    dump.open(a.dump);
    if (!dump) {
      return fail(a.dump + ": cannot be written");
    }
    dump.precision(9);
  }
  ProgressLine bar(std::cerr, isatty(STDERR_FILENO) != 0);
  const auto showProgress = [&](double share) { bar.show(static_cast<int>(100.0 * share), 100); };
  const auto figures = benchmark::run(*setup, a.dump.empty() ? nullptr : &dump,
                                      a.quiet ? std::function<void(double)>{} : showProgress);
  if (!figures) {
    return fail(figures.error().message);
  }
  if (!a.quiet) {
    showProgress(1.0);
  }
  printTable(a, *figures);
  if (!a.out.empty()) {
    std::ofstream out(a.out);
    out << toJson(a, *figures).dump(2) << "\n";
    if (!out) {
      return fail(a.out + ": cannot be written");
    }
  }
  if (figures->capsized_at_s >= 0.0) {
    std::fprintf(stderr, "tracking_benchmark: capsized at %.1f s; the figures end there\n",
                 figures->capsized_at_s);
    return kCapsizedExit;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app(
      "Closed loop of tracker and plant at 100 Hz; errors of the true position, from 10 s "
      "after a start from rest.");
  app.add_option("--vessel", a.vessel, "NAME of config/vessels or a YAML file")
      ->capture_default_str();
  app.add_option("--path", a.path, "eight, spiral or a CSV with columns t, x, y")
      ->capture_default_str();
  app.add_option("--disturbance", a.disturbance, "none, force10, paper, hard")
      ->check(CLI::IsMember({"none", "force10", "paper", "hard"}))
      ->capture_default_str();
  app.add_option("--method", a.method, "flatness or plain")
      ->check(CLI::IsMember({"flatness", "plain"}))
      ->capture_default_str();
  app.add_option("--estimator", a.estimator, "on or off")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  app.add_option("--seed", a.seed, "of the disturbance and the noise")->capture_default_str();
  app.add_option("--top-speed", a.top_speed_mps, "m/s, of eight and spiral; default by vessel")
      ->check(CLI::Range(0.1, 20.0));
  app.add_option("--noise", a.noise,
                 "odometry noise: times 0.02 m, 0.005 rad, 0.02 m/s, 0.01 rad/s")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  app.add_option("--config", a.config, "options of the tracker")->capture_default_str();
  app.add_option("--out", a.out, "JSON of the figures");
  app.add_option("--dump", a.dump, "CSV of the motion, each cycle");
  app.add_flag("--quiet", a.quiet, "no progress bar");
  CLI11_PARSE(app, argc, argv);
  if (a.top_speed_mps <= 0.0) {
    a.top_speed_mps = defaultTopSpeed(a);
  }
  return runOnce(a);
}
