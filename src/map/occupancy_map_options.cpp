#include "otter_nav/map/occupancy_map.hpp"

namespace otter_nav::map {

Result<OccupancyMapOptions> readOccupancyMapOptions(config::Section section) {
  const std::string where = section.where();
  Result<OccupancyMapOptions> options = config::read<OccupancyMapOptions>(std::move(section));
  if (options && options->band.min_m >= options->band.max_m) {
    return failure(where + ": parameter 'band_min_m' is not below 'band_max_m'");
  }
  return options;
}

Result<OccupancyMapOptions> loadOccupancyMapOptions(const std::string& path) {
  return config::loadFile(path).and_then(
      [&](const YAML::Node& node) { return readOccupancyMapOptions(config::Section(node, path)); });
}

}  // namespace otter_nav::map
