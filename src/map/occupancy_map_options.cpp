#include "otter_nav/map/occupancy_map.hpp"

namespace otter_nav::map {

Result<OccupancyMapOptions> readOccupancyMapOptions(config::Section section) {
  OccupancyMapOptions options;
  section.read("band_min_m", options.band.min_m, {-10.0, 100.0});
  section.read("band_max_m", options.band.max_m, {-10.0, 100.0});
  section.read("hit_probability", options.hit_probability, {0.5, 0.99});
  section.read("miss_probability", options.miss_probability, {0.01, 0.5});
  section.read("occupied_probability", options.occupied_probability, {0.5, 0.99});
  section.read("min_probability", options.min_probability, {0.001, 0.5});
  section.read("max_probability", options.max_probability, {0.5, 0.999});
  section.read("hull_length_m", options.hull_length_m, {0.0, 100.0});
  section.read("hull_beam_m", options.hull_beam_m, {0.0, 100.0});
  section.read("hull_margin_m", options.hull_margin_m, {0.0, 10.0});
  section.read("sensor_ahead_m", options.sensor_ahead_m, {-100.0, 100.0});
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  if (options.band.min_m >= options.band.max_m) {
    return failure(section.where() + ": parameter 'band_min_m' is not below 'band_max_m'");
  }
  if (options.occupied_probability > options.max_probability) {
    return failure(section.where() +
                   ": parameter 'occupied_probability' is above 'max_probability'");
  }
  return options;
}

}  // namespace otter_nav::map
