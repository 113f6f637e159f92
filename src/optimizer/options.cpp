#include "otter_nav/optimizer/global_optimizer.hpp"
#include "otter_nav/optimizer/local_optimizer.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr config::Range kLength{0.0, 20.0};
constexpr config::Range kShare{0.1, 1.0};
constexpr config::Range kWeight{0.0, 1e6};
constexpr config::Range kPositiveWeight{1e-9, 1e6};
constexpr config::Range kSpeed{0.5, 20.0};
constexpr config::Range kYawRate{0.1, 10.0};
constexpr config::Range kForce{0.1, 1000.0};

}  // namespace

Result<GlobalOptions> readGlobalOptions(config::Section section) {
  GlobalOptions o;
  section.read("clearance_m", o.clearance_m, kLength);
  section.read("clearance_margin_m", o.clearance_margin_m, kLength);
  section.read("keep_hull_clear", o.keep_hull_clear);
  section.read("thrust_share", o.thrust_share, kShare);
  section.read("thrust_margin", o.thrust_margin, {0.0, 0.5});
  section.read("speed_max_mps", o.speed_max_mps, kSpeed);
  section.read("yaw_rate_max_radps", o.yaw_rate_max_radps, kYawRate);
  section.read("heading_force_min_n", o.heading_force_min_n, kForce);
  section.read("spin_thrust_share", o.spin_thrust_share, kShare);
  section.read("spin_rate_max_radps", o.spin_rate_max_radps, kYawRate);
  section.read("spin_angle_rad", o.spin_angle_rad, {0.0, 3.2});
  section.read("drift_mps", o.drift_mps, {0.0, 5.0});
  section.read("surge_ramp_s", o.surge_ramp_s, {0.15, 5.0});
  section.read("brake_ramp_s", o.brake_ramp_s, {0.15, 5.0});
  section.read("astern_share", o.astern_share, kShare);
  section.read("arrival_speed_share", o.arrival_speed_share, kShare);
  section.read("dilation_max", o.dilation_max, {0.0, 0.5});
  section.read("piece_length_m", o.piece_length_m, {1.0, 50.0});
  section.read("weight_time", o.weight_time, kPositiveWeight);
  section.read("weight_length", o.weight_length, kWeight);
  section.read("weight_smooth", o.weight_smooth, kPositiveWeight);
  section.read("weight_clearance", o.weight_clearance, kPositiveWeight);
  section.read("weight_dynamics", o.weight_dynamics, kPositiveWeight);
  section.read("weight_original", o.weight_original, kWeight);
  section.read("weight_smooth_first", o.weight_smooth_first, kPositiveWeight);
  section.read("weight_growth", o.weight_growth, {1.0, 100.0});
  section.read("rounds", o.rounds, {1, 100});
  section.read("quicken_rounds", o.quicken_rounds, {0, 100});
  section.read("quicken_growth", o.quicken_growth, {1.0, 10.0});
  section.read("iterations_per_round", o.iterations_per_round, {1, 1000});
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  return o;
}

Result<LocalOptions> readLocalOptions(config::Section section) {
  LocalOptions o;
  section.read("clearance_m", o.clearance_m, kLength);
  section.read("clearance_margin_m", o.clearance_margin_m, kLength);
  section.read("push_max_m", o.push_max_m, kLength);
  section.read("speed_max_mps", o.speed_max_mps, kSpeed);
  section.read("force_share", o.force_share, kShare);
  section.read("heading_force_min_n", o.heading_force_min_n, kForce);
  section.read("yaw_rate_max_radps", o.yaw_rate_max_radps, kYawRate);
  section.read("weight_smooth", o.weight_smooth, kPositiveWeight);
  section.read("weight_clearance", o.weight_clearance, kPositiveWeight);
  section.read("weight_dynamics", o.weight_dynamics, kWeight);
  section.read("weight_original", o.weight_original, kPositiveWeight);
  section.read("weight_growth", o.weight_growth, {1.0, 100.0});
  section.read("segments", o.segments, {2, kMaxSegments});
  section.read("attempts", o.attempts, {1, 100});
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  return o;
}

}  // namespace otter_nav::optimizer
