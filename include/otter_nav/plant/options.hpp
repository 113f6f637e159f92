// Everything about a plant that can be chosen: config/plant.yaml, config/disturbances/*.yaml, and
// the vessel's own file.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "otter_nav/ais/local_frame.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/result.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::plant {

// Disturbances: directions are those something moves towards, rad counter-clockwise from east.
inline constexpr config::Range kDirectionRange{-2.0 * kPi, 2.0 * kPi};
inline constexpr config::Range kCorrelationRange{0.01, 1e5};

// Mean, a slow variation of speed and direction, gusts along the wind: first-order Gauss-Markov
// processes (Fossen 2021, section 10.1; the gust's first-order spectrum is Dryden's).
struct WindOptions {
  double speed_mps = 0.0;
  double direction_rad = 0.0;
  double slow_deviation_mps = 0.0;
  double direction_deviation_rad = 0.0;
  double slow_time_s = 100.0;
  double gust_intensity = 0.0;
  double gust_time_s = 5.0;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("speed_mps", o.speed_mps, {0.0, 40.0}, "mean");
    fields("direction_rad", o.direction_rad, kDirectionRange, "towards, from east");
    fields("slow_deviation_mps", o.slow_deviation_mps, {0.0, 10.0},
           "standard deviation of the speed's slow variation");
    fields("direction_deviation_rad", o.direction_deviation_rad, {0.0, kPi},
           "and of the direction's");
    fields("slow_time_s", o.slow_time_s, kCorrelationRange, "their correlation time");
    fields("gust_intensity", o.gust_intensity, {0.0, 1.0},
           "standard deviation of the gusts over the mean speed");
    fields("gust_time_s", o.gust_time_s, kCorrelationRange, "their correlation time");
  }
};

struct CurrentOptions {
  double speed_mps = 0.0;
  double direction_rad = 0.0;
  double turning_radps = 0.0;
  double slow_deviation_mps = 0.0;
  double slow_time_s = 100.0;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("speed_mps", o.speed_mps, {0.0, 5.0}, "mean");
    fields("direction_rad", o.direction_rad, kDirectionRange, "towards, from east");
    fields("turning_radps", o.turning_radps, {-1.0, 1.0}, "the direction turns at this rate");
    fields("slow_deviation_mps", o.slow_deviation_mps, {0.0, 2.0},
           "standard deviation of the speed's slow variation");
    fields("slow_time_s", o.slow_time_s, kCorrelationRange, "its correlation time");
  }
};

// A regular wave; its phase is zero at the origin at time zero.
struct WaveComponent {
  double amplitude_m = 0.0;
  double period_s = 1.0;
  double direction_rad = 0.0;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("amplitude_m", o.amplitude_m, {0.0, 2.0}, "half the height");
    fields("period_s", o.period_s, {0.2, 60.0}, "at a fixed place");
    fields("direction_rad", o.direction_rad, kDirectionRange, "towards, from east");
  }
};

// JONSWAP (Hasselmann and others 1973), normalised to the significant height, with random phases
// and cos^2s spreading.
struct SpectrumOptions {
  double significant_height_m = 0.0;
  double peak_period_s = 2.2;
  double peakedness = 3.3;
  double direction_rad = 0.0;
  double spreading_exponent = 10.0;
  int components = 24;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("significant_height_m", o.significant_height_m, {0.0, 2.0}, "0: no sea");
    fields("peak_period_s", o.peak_period_s, {0.5, 30.0}, "of most energy");
    fields("peakedness", o.peakedness, {1.0, 10.0}, "gamma");
    fields("direction_rad", o.direction_rad, kDirectionRange, "towards, from east");
    fields("spreading_exponent", o.spreading_exponent, {0.0, 1000.0}, "s of cos^2s");
    fields("components", o.components, {1.0, 1000.0}, "regular waves it is made of");
  }
};

struct WaveOptions {
  std::vector<WaveComponent> components;
  SpectrumOptions spectrum;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields.groups("components", o.components, "regular waves");
    fields.group("spectrum", o.spectrum, "JONSWAP, added to them");
  }
};

// One file a preset (config/disturbances).
struct EnvironmentOptions {
  std::string name = "none";
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();
  WindOptions wind;
  CurrentOptions current;
  WaveOptions waves;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("name", o.name, "of the preset");
    fields.vector("force_n", o.force_n, {-500.0, 500.0}, "constant, east and north");
    fields.group("wind", o.wind, "the air over ground");
    fields.group("current", o.current, "the water over ground");
    fields.group("waves", o.waves, "of the surface");
  }
};

// Load of the plant model `otter`.
struct PayloadOptions {
  double mass_kg = 25.0;
  Eigen::Vector3d position_m{0.05, 0.0, -0.35};

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("mass_kg", o.mass_kg, {0.0, 45.0}, "carried on deck");
    fields.vector("position_m", o.position_m, {-1.0, 1.0}, "forward, starboard, down of midships");
  }
};

// Standard deviations of what odometry reports about the truth, and its delay.
struct OdometryOptions {
  double position_noise_m = 0.0;
  double heading_noise_rad = 0.0;
  double velocity_noise_mps = 0.0;
  double yaw_rate_noise_radps = 0.0;
  double latency_s = 0.0;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("position_noise_m", o.position_noise_m, {0.0, 10.0}, "standard deviation, east, north");
    fields("heading_noise_rad", o.heading_noise_rad, {0.0, 1.0}, "standard deviation");
    fields("velocity_noise_mps", o.velocity_noise_mps, {0.0, 5.0}, "standard deviation, each axis");
    fields("yaw_rate_noise_radps", o.yaw_rate_noise_radps, {0.0, 1.0}, "standard deviation");
    fields("latency_s", o.latency_s, {0.0, 5.0}, "of the report behind the truth");
  }
};

struct LidarOptions {
  int beams = 720;
  double range_min_m = 0.2;
  double range_max_m = 25.0;
  double rate_hz = 15.0;
  Eigen::Vector3d position_m{0.5, 0.0, 0.8};
  double range_noise_m = 0.01;
  double dropout_probability = 0.001;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("beams", o.beams, {1.0, 100000.0}, "over the full circle, from astern");
    fields("range_min_m", o.range_min_m, {0.0, 10.0}, "nearer returns are -inf");
    fields("range_max_m", o.range_max_m, {0.1, 1000.0}, "farther ones are +inf");
    fields("rate_hz", o.rate_hz, {0.1, 100.0}, "turns a second");
    fields.vector("position_m", o.position_m, {-5.0, 5.0}, "ahead, port, up of base_link");
    fields("range_noise_m", o.range_noise_m, {0.0, 1.0}, "standard deviation");
    fields("dropout_probability", o.dropout_probability, {0.0, 1.0}, "of each beam: NaN");
  }
};

// A sensor of other vessels' positions round about.
struct RadarOptions {
  double range_m = 150.0;
  double noise_m = 1.0;
  static constexpr double kRateHz = 1.0;
  static constexpr double kDetectionProbability = 0.95;
  static constexpr double kFalsePerScan = 0.05;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("range_m", o.range_m, {0.0, 100000.0}, "it sees this far; 0: there is none");
    fields("noise_m", o.noise_m, {0.0, 100.0}, "standard deviation, each axis");
  }
};

struct Options {
  // The hull, and the model its file asks for (`plant_model`).
  vessel::Parameters vessel;
  EnvironmentOptions disturbance;
  // Whether the propellers of the model `otter` take time; without, a speed acts at once.
  bool propeller_lag = true;

  double command_timeout_s = 0.5;
  PayloadOptions payload;
  OdometryOptions odometry;
  LidarOptions lidar;
  RadarOptions radar;
  ais::Datum datum;

  // config/plant.yaml: all but the first three.
  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("command_timeout_s", o.command_timeout_s, {0.01, 60.0},
           "without a command for longer, thrust falls to zero");
    fields.group("payload", o.payload, "of the plant model otter");
    fields.group("odometry", o.odometry, "what is reported of the truth; zeros report it as it is");
    fields.group("lidar", o.lidar, "where it sits and what it sees");
    fields.group("radar", o.radar, "once a second, positions of other vessels");
    fields.group("datum", o.datum, "the map's origin on the globe, for AIS");
  }
};

// Reads config/disturbances/NAME.yaml or another file.
[[nodiscard]] Result<EnvironmentOptions> loadDisturbance(const std::string& name_or_path);
// config/plant.yaml: the vessel and the disturbance are left as they are.
[[nodiscard]] Result<Options> readOptions(config::Section section);
// The vessel, config/plant.yaml from `plant_yaml`, and the preset from `disturbance_yaml`.
[[nodiscard]] Result<Options> loadOptions(const vessel::Parameters& vessel,
                                          const std::string& plant_yaml,
                                          const std::string& disturbance_yaml);

}  // namespace otter_nav::plant
