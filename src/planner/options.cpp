#include "otter_nav/planner/options.hpp"

#include "otter_nav/config/fields.hpp"

namespace otter_nav::planner {

Result<Options> loadOptions(const std::string& folder) {
  auto options = config::load<Options>(folder + "/planner.yaml");
  if (!options) {
    return options;
  }
  const auto topology = config::load<topology::Options>(folder + "/topology.yaml");
  if (!topology) {
    return failure(topology.error().message);
  }
  options->topology = *topology;
  return options;
}

}  // namespace otter_nav::planner
