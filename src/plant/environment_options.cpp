#include "otter_nav/plant/environment_options.hpp"

#include "otter_nav/base/angles.hpp"

namespace otter_nav::plant {
namespace {

constexpr config::Range kDirection{-2.0 * kPi, 2.0 * kPi};
constexpr config::Range kCorrelation{0.01, 1e5};

Status readWind(config::Section section, WindOptions& wind) {
  section.read("speed_mps", wind.speed_mps, {0.0, 40.0});
  section.read("direction_rad", wind.direction_rad, kDirection);
  section.read("slow_deviation_mps", wind.slow_deviation_mps, {0.0, 10.0});
  section.read("direction_deviation_rad", wind.direction_deviation_rad, {0.0, kPi});
  section.read("slow_time_s", wind.slow_time_s, kCorrelation);
  section.read("gust_intensity", wind.gust_intensity, {0.0, 1.0});
  section.read("gust_time_s", wind.gust_time_s, kCorrelation);
  return section.finish();
}

Status readCurrent(config::Section section, CurrentOptions& current) {
  section.read("speed_mps", current.speed_mps, {0.0, 5.0});
  section.read("direction_rad", current.direction_rad, kDirection);
  section.read("turning_radps", current.turning_radps, {-1.0, 1.0});
  section.read("slow_deviation_mps", current.slow_deviation_mps, {0.0, 2.0});
  section.read("slow_time_s", current.slow_time_s, kCorrelation);
  return section.finish();
}

Status readSpectrum(config::Section section, SpectrumOptions& spectrum) {
  section.read("significant_height_m", spectrum.significant_height_m, {0.0, 2.0});
  section.read("peak_period_s", spectrum.peak_period_s, {0.5, 30.0});
  section.read("peakedness", spectrum.peakedness, {1.0, 10.0});
  section.read("direction_rad", spectrum.direction_rad, kDirection);
  section.read("spreading_exponent", spectrum.spreading_exponent, {0.0, 1000.0});
  section.read("components", spectrum.components, {1.0, 1000.0});
  return section.finish();
}

Status readComponent(config::Section section, WaveComponent& wave) {
  section.read("amplitude_m", wave.amplitude_m, {0.0, 2.0});
  section.read("period_s", wave.period_s, {0.2, 60.0});
  section.read("direction_rad", wave.direction_rad, kDirection);
  return section.finish();
}

Status readWaves(config::Section section, WaveOptions& waves) {
  for (const config::Section& component : section.children("components")) {
    waves.components.emplace_back();
    if (Status status = readComponent(component, waves.components.back()); !status) {
      return status;
    }
  }
  if (Status status = readSpectrum(section.child("spectrum"), waves.spectrum); !status) {
    return status;
  }
  return section.finish();
}

}  // namespace

Result<EnvironmentOptions> readEnvironmentOptions(config::Section section) {
  EnvironmentOptions options;
  section.read("name", options.name);
  std::vector<double> force;
  section.read("force_n", force, 2, {-500.0, 500.0});
  if (force.size() == 2) {
    options.force_n = {force[0], force[1]};
  }
  Status status = readWind(section.child("wind"), options.wind);
  if (status) {
    status = readCurrent(section.child("current"), options.current);
  }
  if (status) {
    status = readWaves(section.child("waves"), options.waves);
  }
  if (status) {
    status = section.finish();
  }
  if (!status) {
    return failure(status.error().message);
  }
  return options;
}

Result<EnvironmentOptions> loadDisturbance(const std::string& path) {
  const Result<YAML::Node> node = config::loadFile(path);
  if (!node) {
    return failure(node.error().message);
  }
  return readEnvironmentOptions(config::Section(*node, path));
}

}  // namespace otter_nav::plant
