// Wind, current, waves and plain forces: one YAML file a preset (config/disturbances).
// Directions are those something moves towards, rad counter-clockwise from east.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"

namespace otter_nav::plant {

// Mean, a slow variation of speed and direction, gusts along the wind: first-order Gauss-Markov
// processes (Fossen 2021, section 10.1; the gust's first-order spectrum is Dryden's).
struct WindOptions {
  double speed_mps = 0.0;
  double direction_rad = 0.0;
  double slow_deviation_mps = 0.0;       // standard deviation of the speed's slow variation
  double direction_deviation_rad = 0.0;  // and of the direction's
  double slow_time_s = 100.0;            // their correlation time
  double gust_intensity = 0.0;           // standard deviation of the gusts over the mean speed
  double gust_time_s = 5.0;              // their correlation time
};

struct CurrentOptions {
  double speed_mps = 0.0;
  double direction_rad = 0.0;
  double turning_radps = 0.0;       // the direction turns at this rate
  double slow_deviation_mps = 0.0;  // standard deviation of the speed's slow variation
  double slow_time_s = 100.0;
};

// A regular wave; its phase is zero at the origin at time zero.
struct WaveComponent {
  double amplitude_m = 0.0;
  double period_s = 1.0;
  double direction_rad = 0.0;
};

// JONSWAP (Hasselmann and others 1973), normalised to the significant height, with random phases
// and cos^2s spreading.
struct SpectrumOptions {
  double significant_height_m = 0.0;
  double peak_period_s = 2.2;
  double peakedness = 3.3;
  double direction_rad = 0.0;
  double spreading_exponent = 10.0;  // s
  int components = 24;
};

struct WaveOptions {
  std::vector<WaveComponent> components;
  SpectrumOptions spectrum;  // added to the components
};

struct EnvironmentOptions {
  std::string name = "none";
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();  // constant, map frame
  WindOptions wind;
  CurrentOptions current;
  WaveOptions waves;
};

[[nodiscard]] Result<EnvironmentOptions> readEnvironmentOptions(config::Section section);
[[nodiscard]] Result<EnvironmentOptions> loadDisturbance(const std::string& path);

}  // namespace otter_nav::plant
