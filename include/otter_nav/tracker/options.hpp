// Settings of the tracker (config/tracker.yaml, docs/tracker.md).
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/tracker/estimator_options.hpp"

namespace otter_nav::tracker {

// Diagonals of Q and R (paper, section V-B) per second of horizon: errors of the state in its own
// units, thrusts in N.
struct Weights {
  double position = 100.0;       // per m^2
  double heading = 1.0;          // per rad^2
  double surge = 1.0;            // per (m/s)^2
  double sway = 1.0;             // per (m/s)^2
  double yaw_rate = 1.0;         // per (rad/s)^2
  double thrust = 1e-4;          // per N^2, each thruster
  double terminal_gain_s = 1.0;  // the last state weighs as this many seconds
};

// What the reference takes from the trajectory.
enum class Method {
  kFlatness,  // all six states and both thrusts
  kPlain,     // position, heading of the path and speed along it (the paper's comparison)
};

// What counts as an odometry one can steer by.
struct OdometryOptions {
  double predict_through_s = 0.5;  // gaps up to here are bridged by the model
  double jump_m = 1.0;             // a step off the prediction that is not believed at once
  double jump_rad = 0.5;
  double believe_jump_after_s = 0.3;  // a jump that stays this long is the truth
  double brake_blind_s = 5.0;         // braking by the model alone; then no thrust
  double latency_s = 0.0;             // age of the state at its stamp, known delays of the sensor
};

// Holding station at the end of a trajectory.
struct HoldingOptions {
  double heading_radius_m = 0.5;      // inside, the goal's heading is held
  double weathervane_radius_m = 0.8;  // outside, position alone counts
  double surge_gain_nspm = 25.0;      // N per m along the hull
  double surge_damping_kgps = 30.0;   // N per m/s
  double yaw_gain_nm = 25.0;          // N m per rad
  double yaw_damping_nms = 20.0;      // N m per rad/s
  double side_load_n = 15.0;          // abeam; below, the heading may be held again
  double thrust_share = 0.8;          // of the limits
};

struct Options {
  Method method = Method::kFlatness;
  int stages = 20;         // N: 1 to kMaxStages
  double horizon_s = 2.0;  // stages are of equal length
  double period_s = 0.01;  // of the control loop
  Weights flatness;
  Weights plain;
  double thrust_share = 1.0;  // of the thrusters' limits the tracker may use
  // Of either thrust's command, N/s: the command never jumps. With `plan_thrust_rate` the plan
  // knows of it too (thrusts it cannot reach in time are out of its bounds).
  double thrust_rate_nps = 1000.0;
  bool plan_thrust_rate = true;
  double keep_plan_s = 0.3;       // how long the last good plan stands in for a failing solver
  double far_m = 0.5;             // position errors beyond weigh in proportion, not squared
  double heading_step_rad = 0.5;  // most that one iteration turns the plan's headings
  double step_share = 0.5;        // of each iteration's step: whole ones swing in saturation
  // The reference waits for a vessel that falls behind it by more than this (at the start, or where
  // the thrust is spent), and catches up by at most this share of time when it can.
  double leash_m = 1.0;
  double catch_up_rate = 0.5;
  // A reference further from the vessel than this is approached along a joining curve.
  double join_offset_m = 0.5;
  double join_speed_mps = 0.7;
  double arrival_radius_m = 1.0;  // for `at goal` in the status
  double arrival_heading_rad = 0.17;
  EstimatorOptions estimator;
  OdometryOptions odometry;
  HoldingOptions holding;
};

[[nodiscard]] Result<Options> readOptions(config::Section section);
[[nodiscard]] Result<Options> loadOptions(const std::string& path);

}  // namespace otter_nav::tracker
