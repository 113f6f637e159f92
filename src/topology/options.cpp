#include "otter_nav/topology/guide_path.hpp"

namespace otter_nav::topology {

Result<Options> readOptions(config::Section section) {
  Options options;
  section.read("turning_radius_m", options.turning_radius_m, {0.1, 100.0});
  section.read("clearance_m", options.clearance_m, {0.0, 10.0});
  section.read("clearance_margin_m", options.clearance_margin_m, {0.0, 1.0});
  section.read("safe_distance_m", options.safe_distance_m, {0.0, 20.0});
  section.read("corridor_max_m", options.corridor_max_m, {0.1, 100.0});
  section.read("lattice_m", options.lattice_m, {0.01, 20.0});
  section.read("long_way_m", options.long_way_m, {0.0, 1e6});
  section.read("greed", options.greed, {1.0, 2.0});
  section.read("local_window_m", options.local_window_m, {1.0, 1000.0});
  section.read("max_repairs", options.max_repairs, {0.0, 1000.0});
  section.read("good_ratio", options.good_ratio, {1.0, 10.0});
  section.read("max_expansions", options.max_expansions, {1.0, 1e8});
  if (const Status status = section.finish(); !status) {
    return failure(status.error().message);
  }
  if (options.safe_distance_m < options.clearance_m) {
    return failure(section.where() + ": parameter 'safe_distance_m' is below 'clearance_m'");
  }
  return options;
}

}  // namespace otter_nav::topology
