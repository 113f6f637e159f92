#include <algorithm>
#include <functional>

#include "otter_nav/config/fields.hpp"
#include "otter_nav/mission/supervisor.hpp"

namespace otter_nav::mission {

Status checkSpeedMax(double speed_mps) {
  constexpr double kLeastMps = 0.2;
  if (speed_mps == 0.0 || speed_mps >= kLeastMps) {
    return {};
  }
  return failure("parameter 'speed_max_mps' is " + std::to_string(speed_mps) +
                 ", allowed are 0 (no limit) and 0.2 or more");
}

Result<SupervisorOptions> readSupervisorOptions(config::Section section) {
  const std::string where = section.where();
  Result<SupervisorOptions> options = config::read<SupervisorOptions>(std::move(section));
  if (!options) {
    return options;
  }
  const std::vector<double>& levels = options->side_clearances_m;
  if (!std::is_sorted(levels.begin(), levels.end(), std::greater<>())) {
    return failure(where + ": parameter 'side_clearances_m' must fall from first to last");
  }
  if (options->critical_side_clearance_m > levels.back()) {
    return failure(where +
                   ": parameter 'critical_side_clearance_m' must not be above the last of "
                   "'side_clearances_m'");
  }
  const encounter::Options& encounter = options->encounter;
  if (encounter.outline_least_m > encounter.outline_wanted_m) {
    return failure(where + "/encounter: parameter 'outline_least_m' is above 'outline_wanted_m'");
  }
  if (const Status status = checkSpeedMax(options->speed_max_mps); !status) {
    return failure(where + ": " + status.error().message);
  }
  return options;
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
