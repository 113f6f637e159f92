#include "otter_nav/optimizer/global_optimizer.hpp"
#include "otter_nav/optimizer/local_optimizer.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr config::Range kLength{0.0, 20.0};
constexpr config::Range kShare{0.1, 1.0};
constexpr config::Range kWeight{0.0, 1e6};
constexpr config::Range kPositiveWeight{1e-9, 1e6};

}  // namespace

Result<GlobalOptions> readGlobalOptions(config::Section section) {
  GlobalOptions o;
  section.read("clearance_margin_m", o.clearance_margin_m, kLength);
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
  section.read("clearance_margin_m", o.clearance_margin_m, kLength);
  section.read("push_max_m", o.push_max_m, kLength);
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
