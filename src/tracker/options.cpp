#include "otter_nav/tracker/options.hpp"

#include "otter_nav/tracker/limits.hpp"

namespace otter_nav::tracker {
namespace {

constexpr config::Range kWeight{0.0, 1e9};
constexpr config::Range kPositive{1e-6, 1e6};
constexpr config::Range kNotNegative{0.0, 1e6};
constexpr config::Range kShare{0.05, 1.0};

Status readWeights(config::Section section, Weights& w) {
  section.read("position", w.position, kWeight);
  section.read("heading", w.heading, kWeight);
  section.read("surge", w.surge, kWeight);
  section.read("sway", w.sway, kWeight);
  section.read("yaw_rate", w.yaw_rate, kWeight);
  section.read("thrust", w.thrust, {1e-9, 1e9});
  section.read("terminal_gain_s", w.terminal_gain_s, kNotNegative);
  return section.finish();
}

Status readEstimator(config::Section section, EstimatorOptions& o) {
  section.read("enabled", o.enabled);
  section.read("position_sigma_m", o.position_sigma_m, kPositive);
  section.read("heading_sigma_rad", o.heading_sigma_rad, kPositive);
  section.read("velocity_sigma_mps", o.velocity_sigma_mps, kPositive);
  section.read("yaw_rate_sigma_radps", o.yaw_rate_sigma_radps, kPositive);
  section.read("velocity_walk_mps", o.velocity_walk_mps, kNotNegative);
  section.read("yaw_rate_walk_radps", o.yaw_rate_walk_radps, kNotNegative);
  section.read("force_walk_n", o.force_walk_n, kNotNegative);
  section.read("moment_walk_nm", o.moment_walk_nm, kNotNegative);
  section.read("current_walk_mps", o.current_walk_mps, kNotNegative);
  section.read("wind_walk_m2ps2", o.wind_walk_m2ps2, kNotNegative);
  section.read("moment_walk_in_wind_nm", o.moment_walk_in_wind_nm, kNotNegative);
  section.read("wave_velocity_mps", o.wave_velocity_mps, kNotNegative);
  section.read("wave_yaw_rate_radps", o.wave_yaw_rate_radps, kNotNegative);
  section.read("wave_frequency_radps", o.wave_frequency_radps, kPositive);
  section.read("wave_damping", o.wave_damping, kPositive);
  section.read("force_sigma_n", o.force_sigma_n, kNotNegative);
  section.read("moment_sigma_nm", o.moment_sigma_nm, kNotNegative);
  section.read("current_sigma_mps", o.current_sigma_mps, kNotNegative);
  section.read("wind_sigma_m2ps2", o.wind_sigma_m2ps2, kNotNegative);
  section.read("force_max_n", o.force_max_n, kNotNegative);
  section.read("moment_max_nm", o.moment_max_nm, kNotNegative);
  section.read("current_max_mps", o.current_max_mps, kNotNegative);
  section.read("wind_max_mps", o.wind_max_mps, kNotNegative);
  return section.finish();
}

Status readOdometry(config::Section section, OdometryOptions& o) {
  section.read("predict_through_s", o.predict_through_s, {0.0, 5.0});
  section.read("jump_m", o.jump_m, kPositive);
  section.read("jump_rad", o.jump_rad, kPositive);
  section.read("believe_jump_after_s", o.believe_jump_after_s, {0.0, 10.0});
  section.read("brake_blind_s", o.brake_blind_s, {0.0, 30.0});
  section.read("latency_s", o.latency_s, {0.0, 1.0});
  return section.finish();
}

Status readHolding(config::Section section, HoldingOptions& o) {
  section.read("heading_radius_m", o.heading_radius_m, kPositive);
  section.read("weathervane_radius_m", o.weathervane_radius_m, {o.heading_radius_m, 100.0});
  section.read("surge_gain_nspm", o.surge_gain_nspm, kPositive);
  section.read("surge_damping_kgps", o.surge_damping_kgps, kPositive);
  section.read("yaw_gain_nm", o.yaw_gain_nm, kPositive);
  section.read("yaw_damping_nms", o.yaw_damping_nms, kPositive);
  section.read("side_load_n", o.side_load_n, kNotNegative);
  section.read("thrust_share", o.thrust_share, kShare);
  return section.finish();
}

}  // namespace

Result<Options> readOptions(config::Section section) {
  Options o;
  std::string method;
  section.read("method", method, {"flatness", "plain"});
  o.method = method == "plain" ? Method::kPlain : Method::kFlatness;
  section.read("stages", o.stages, {2.0, static_cast<double>(kMaxStages)});
  section.read("horizon_s", o.horizon_s, {0.1, 20.0});
  section.read("period_s", o.period_s, {0.001, 0.2});
  section.read("thrust_share", o.thrust_share, kShare);
  section.read("thrust_rate_nps", o.thrust_rate_nps, kPositive);
  section.read("plan_thrust_rate", o.plan_thrust_rate);
  section.read("keep_plan_s", o.keep_plan_s, {0.0, 2.0});
  section.read("far_m", o.far_m, kPositive);
  section.read("heading_step_rad", o.heading_step_rad, kPositive);
  section.read("step_share", o.step_share, kShare);
  section.read("leash_m", o.leash_m, kPositive);
  section.read("catch_up_rate", o.catch_up_rate, {0.0, 10.0});
  section.read("join_offset_m", o.join_offset_m, kPositive);
  section.read("join_speed_mps", o.join_speed_mps, kPositive);
  section.read("arrival_radius_m", o.arrival_radius_m, kPositive);
  section.read("arrival_heading_rad", o.arrival_heading_rad, kPositive);
  Status status = readWeights(section.child("flatness"), o.flatness);
  if (status) {
    status = readWeights(section.child("plain"), o.plain);
  }
  if (status) {
    status = readEstimator(section.child("estimator"), o.estimator);
  }
  if (status) {
    status = readOdometry(section.child("odometry"), o.odometry);
  }
  if (status) {
    status = readHolding(section.child("holding"), o.holding);
  }
  if (status) {
    status = section.finish();
  }
  if (!status) {
    return failure(status.error().message);
  }
  return o;
}

Result<Options> loadOptions(const std::string& path) {
  const Result<YAML::Node> node = config::loadFile(path);
  if (!node) {
    return failure(node.error().message);
  }
  return readOptions(config::Section(*node, path));
}

}  // namespace otter_nav::tracker
