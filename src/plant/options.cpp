#include "otter_nav/plant/options.hpp"

#include <utility>

#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/config/share.hpp"

namespace otter_nav::plant {

Result<EnvironmentOptions> loadDisturbance(const std::string& name_or_path) {
  return config::presetFile("disturbances", name_or_path)
      .and_then(config::load<EnvironmentOptions>);
}

Result<Options> readOptions(config::Section section) {
  const std::string where = section.where();
  Result<Options> options = config::read<Options>(std::move(section));
  if (options && options->lidar.range_min_m >= options->lidar.range_max_m) {
    return failure(where + "/lidar: parameter 'range_min_m' is not below 'range_max_m'");
  }
  return options;
}

Result<Options> loadOptions(const vessel::Parameters& vessel, const std::string& plant_yaml,
                            const std::string& disturbance) {
  Result<Options> options = config::loadFile(plant_yaml).and_then([&](const YAML::Node& node) {
    return readOptions(config::Section(node, plant_yaml));
  });
  const Result<EnvironmentOptions> preset = loadDisturbance(disturbance);
  if (const Status status = firstFailure(options, preset); !status) {
    return failure(status.error().message);
  }
  options->vessel = vessel;
  options->disturbance = *preset;
  return options;
}

}  // namespace otter_nav::plant
