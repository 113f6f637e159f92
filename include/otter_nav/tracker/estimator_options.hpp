// Settings of the disturbance estimator.
#pragma once

namespace otter_nav::tracker {

// Standard deviations; the random walks are per square root of a second.
struct EstimatorOptions {
  bool enabled = true;
  // Odometry.
  double position_sigma_m = 0.02;
  double heading_sigma_rad = 0.005;
  double velocity_sigma_mps = 0.02;
  double yaw_rate_sigma_radps = 0.01;
  // What the model leaves open.
  double velocity_walk_mps = 0.02;
  double yaw_rate_walk_radps = 0.02;
  // Force fixed in the earth frame, moment about the yaw axis, current.
  double force_walk_n = 5.0;
  double moment_walk_nm = 2.0;
  double current_walk_mps = 0.0;  // 0: the current is not estimated, the force carries it
  // For vessels whose model knows wind loads: of |w| w, and of the moment that these leave.
  double wind_walk_m2ps2 = 10.0;
  double moment_walk_in_wind_nm = 2.0;
  // Motion at the waves' frequency that the propellers should not chase: standard deviations of its
  // velocities (0: none is told apart), the middle of its band, its relative damping.
  double wave_velocity_mps = 0.0;
  double wave_yaw_rate_radps = 0.0;
  double wave_frequency_radps = 2.0;
  double wave_damping = 0.2;
  // What is not known of them at the start.
  double force_sigma_n = 10.0;
  double moment_sigma_nm = 5.0;
  double current_sigma_mps = 0.0;
  double wind_sigma_m2ps2 = 30.0;
  double force_max_n = 80.0;
  double moment_max_nm = 20.0;
  double current_max_mps = 1.5;
  double wind_max_mps = 20.0;
};

}  // namespace otter_nav::tracker
