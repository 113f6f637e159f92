#include "otter_nav/plant/options.hpp"

#include "otter_nav/base/first_failure.hpp"

namespace otter_nav::plant {

Result<EnvironmentOptions> loadDisturbance(const std::string& path) {
  return config::load<EnvironmentOptions>(path);
}

Result<Options> loadOptions(const vessel::Parameters& vessel, const std::string& plant_yaml,
                            const std::string& disturbance_yaml) {
  Result<Options> options = config::load<Options>(plant_yaml);
  const Result<EnvironmentOptions> disturbance = loadDisturbance(disturbance_yaml);
  if (const Status status = firstFailure(options, disturbance); !status) {
    return failure(status.error().message);
  }
  options->vessel = vessel;
  options->disturbance = *disturbance;
  return options;
}

}  // namespace otter_nav::plant
