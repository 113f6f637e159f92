// Settings of the tracker (config/tracker.yaml, docs/tracker.md). What follows from the vessel, and
// what nobody need set, is constants beside what they rule.
#pragma once

#include "otter_nav/config/fields.hpp"
#include "otter_nav/tracker/limits.hpp"

namespace otter_nav::tracker {

// Diagonals of Q and R (paper, section V-B) per second of horizon: errors of the state in its own
// units, thrusts in N. The last state weighs as one second.
struct Weights {
  double position = 100.0;
  double heading = 250.0;
  double surge = 1.0;
  double sway = 1.0;
  double yaw_rate = 0.1;
  double thrust = 3e-4;

  friend bool operator==(const Weights& a, const Weights& b) {
    return a.position == b.position && a.heading == b.heading && a.surge == b.surge &&
           a.sway == b.sway && a.yaw_rate == b.yaw_rate && a.thrust == b.thrust;
  }

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    constexpr config::Range kWeight{0.0, 1e9};
    fields("position", o.position, kWeight, "per m^2");
    fields(
        "heading", o.heading, kWeight,
        "per rad^2, of a hull that its moment turns by 0.2 rad in 1 s; by the square of that time");
    fields("surge", o.surge, kWeight, "per (m/s)^2");
    fields("sway", o.sway, kWeight, "per (m/s)^2");
    fields("yaw_rate", o.yaw_rate, kWeight, "per (rad/s)^2");
    fields("thrust", o.thrust, {1e-9, 1e9}, "per N^2, each thruster");
  }
};

// What the reference takes from the trajectory.
enum class Method {
  kFlatness,  // all six states and both thrusts
  kPlain,     // position, heading of the path and speed along it (the paper's comparison)
};

struct EstimatorOptions {
  bool enabled = true;
  double position_sigma_m = 0.01;
  double heading_sigma_rad = 0.005;
  double velocity_sigma_mps = 0.02;
  double yaw_rate_sigma_radps = 0.01;
  double current_walk_mps = 0.01;
  double wave_velocity_mps = 0.1;
  double wave_yaw_rate_radps = 0.05;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    constexpr config::Range kSigma{1e-6, 1e6};
    constexpr config::Range kNotNegative{0.0, 1e6};
    fields("enabled", o.enabled, "false: no force, moment, wind or current is estimated");
    fields("position_sigma_m", o.position_sigma_m, kSigma, "of the odometry, as the next three");
    fields("heading_sigma_rad", o.heading_sigma_rad, kSigma, "");
    fields("velocity_sigma_mps", o.velocity_sigma_mps, kSigma, "");
    fields("yaw_rate_sigma_radps", o.yaw_rate_sigma_radps, kSigma, "");
    fields("current_walk_mps", o.current_walk_mps, kNotNegative,
           "per sqrt(s), for hulls whose drag ahead and abeam differ; 0: the force carries it");
    fields("wave_velocity_mps", o.wave_velocity_mps, kNotNegative,
           "of motion with the waves, left alone at crawling pace and foreseen under way; 0: none");
    fields("wave_yaw_rate_radps", o.wave_yaw_rate_radps, kNotNegative, "of the same");
  }
};

struct OdometryOptions {
  double latency_s = 0.0;
  double predict_through_s = 0.5;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("latency_s", o.latency_s, {0.0, 1.0}, "age of a state at its stamp");
    fields("predict_through_s", o.predict_through_s, {0.0, 5.0},
           "gaps bridged by the model; after longer ones the vessel brakes");
  }
};

struct Options {
  Method method = Method::kFlatness;
  int stages = 40;
  double horizon_s = 6.0;
  double period_s = 0.01;
  double thrust_rate_nps = 1500.0;
  Weights flatness;
  EstimatorOptions estimator;
  OdometryOptions odometry;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields.choice(
        "method", o.method,
        config::Choices<Method>{{"flatness", Method::kFlatness}, {"plain", Method::kPlain}},
        "flatness: all states and thrusts of the reference; plain: path and speed");
    fields("stages", o.stages, {2.0, static_cast<double>(kMaxStages)},
           "of the horizon, all of one length");
    fields("horizon_s", o.horizon_s, {0.1, 20.0}, "how far the plan looks ahead");
    fields("period_s", o.period_s, {0.001, 0.2}, "of the control loop");
    fields("thrust_rate_nps", o.thrust_rate_nps, {1e-6, 1e6},
           "of each thruster's command, N/s: the plan and the command keep it");
    fields.group("flatness", o.flatness, "weights per second of horizon");
    fields.group("estimator", o.estimator, "standard deviations");
    fields.group("odometry", o.odometry, "");
  }
};

}  // namespace otter_nav::tracker
