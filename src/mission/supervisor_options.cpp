#include <algorithm>
#include <functional>

#include "otter_nav/mission/supervisor.hpp"

namespace otter_nav::mission {

namespace {

void readMargins(config::Section& section, MarginOptions& o) {
  constexpr std::size_t kRungs = 4;
  section.read("plan_clearances_m", o.plan_clearances_m, kRungs, {0.3, 10.0});
  section.read("widening_in_wind", o.widening_in_wind, {0.0, 100.0});
  section.read("thrust_share", o.thrust_share, {0.2, 1.0});
  section.read("thrust_share_min", o.thrust_share_min, {0.2, 1.0});
  section.read("thrust_share_step", o.thrust_share_step, {0.0, 1.0});
  section.read("reserve_in_wind", o.reserve_in_wind, {0.0, 10.0});
}

}  // namespace

Result<SupervisorOptions> readSupervisorOptions(config::Section section) {
  SupervisorOptions o;
  readMargins(section, o.margins);
  section.read("clearance_slack_m", o.clearance_slack_m, {0.0, 5.0});
  section.read("critical_clearance_m", o.critical_clearance_m, {0.1, 10.0});
  section.read("planning_latency_s", o.planning_latency_s, {0.0, 5.0});
  section.read("planning_timeout_s", o.planning_timeout_s, {0.1, 600.0});
  section.read("retry_pause_s", o.retry_pause_s, {0.0, 60.0});
  section.read("rounds_from_rest", o.rounds_from_rest, {1, 1000});
  section.read("stops_max", o.stops_max, {0, 1000});
  section.read("stop_reserve_s", o.stop_reserve_s, {0.0, 10.0});
  section.read("brake_horizon_s", o.brake_horizon_s, {1.0, 100.0});
  section.read("brake_thrust_share", o.brake_thrust_share, {0.1, 1.0});
  section.read("tracking_error_max_m", o.tracking_error_max_m, {0.1, 100.0});
  section.read("odometry_timeout_s", o.odometry_timeout_s, {0.05, 60.0});
  section.read("arrival_distance_m", o.arrival_distance_m, {0.01, 100.0});
  section.read("arrival_heading_rad", o.arrival_heading_rad, {0.01, 3.2});
  section.read("arrival_speed_mps", o.arrival_speed_mps, {0.01, 5.0});
  section.read("settle_s", o.settle_s, {0.1, 600.0});
  section.read("improve_period_s", o.improve_period_s, {0.0, 600.0});
  section.read("improve_share", o.improve_share, {0.0, 1.0});
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  const std::vector<double>& rungs = o.margins.plan_clearances_m;
  if (!std::is_sorted(rungs.begin(), rungs.end(), std::greater<>())) {
    return failure(section.where() +
                   ": parameter 'plan_clearances_m' must fall from first to last");
  }
  if (o.critical_clearance_m > rungs.back()) {
    return failure(section.where() +
                   ": parameter 'critical_clearance_m' must not be above the last of "
                   "'plan_clearances_m'");
  }
  if (o.margins.thrust_share_min > o.margins.thrust_share) {
    return failure(section.where() +
                   ": parameter 'thrust_share_min' must not be above 'thrust_share'");
  }
  return o;
}

Result<SupervisorOptions> loadSupervisorOptions(const std::string& path) {
  const Result<YAML::Node> root = config::loadFile(path);
  if (!root) {
    return failure(root.error().message);
  }
  config::Section section(*root, path);
  Result<SupervisorOptions> options = readSupervisorOptions(section.child("supervisor"));
  if (const Status status = section.finish(); options && !status) {
    return failure(status.error().message);
  }
  return options;
}

}  // namespace otter_nav::mission
