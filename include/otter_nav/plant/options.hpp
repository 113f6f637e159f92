// Everything about a plant that can be chosen: config/plant.yaml and config/disturbances/*.yaml.
#pragma once

#include <Eigen/Core>
#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/plant/environment_options.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::plant {

// Load of the `otter`; the position is forward, starboard, down of midships.
struct PayloadOptions {
  double mass_kg = 25.0;  // 0 to 45
  Eigen::Vector3d position_m{0.05, 0.0, -0.35};
};

// Standard deviations of what odometry reports about the truth, and its delay.
struct OdometryOptions {
  double position_noise_m = 0.0;
  double heading_noise_rad = 0.0;
  double velocity_noise_mps = 0.0;
  double yaw_rate_noise_radps = 0.0;
  double latency_s = 0.0;
};

struct LidarOptions {
  int beams = 720;           // over the full circle, counter-clockwise from astern
  double range_min_m = 0.2;  // nearer returns are -inf
  double range_max_m = 25.0;
  double rate_hz = 15.0;
  Eigen::Vector3d position_m{0.5, 0.0, 0.8};  // in base_link
  double range_noise_m = 0.0;                 // standard deviation
  double dropout_probability = 0.0;           // of each beam: NaN
};

struct Options {
  std::string vessel = "otter_gazebo";  // or "otter"
  double step_s = 0.01;                 // of the integrator, at most
  double command_timeout_s = 0.5;       // without a command for longer, thrust falls to zero
  bool propeller_lag = true;            // 0.1 s on the propeller speeds of `otter`
  PayloadOptions payload;
  OdometryOptions odometry;
  LidarOptions lidar;
  EnvironmentOptions disturbance;
  vessel::Hull hull;
};

// Reads config/plant.yaml, which holds everything but `vessel` and `disturbance`.
[[nodiscard]] Result<Options> readOptions(config::Section section);
// config/plant.yaml from `plant_yaml`, the preset from `disturbance_yaml`.
[[nodiscard]] Result<Options> loadOptions(const std::string& vessel, const std::string& plant_yaml,
                                          const std::string& disturbance_yaml);

}  // namespace otter_nav::plant
