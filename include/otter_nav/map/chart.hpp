// Charts on disk: map_server's YAML beside a PGM or PNG picture, and OctoMap's trees.
#pragma once

#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::map {

// Reads a map_server chart: `image` (PGM, plain or raw, or PNG; relative paths start at the YAML),
// `resolution` (m a cell), `origin` [x m, y m, yaw rad] of the south-west corner (yaw must be 0),
// `negate`, `occupied_thresh`, `free_thresh` and optionally `mode: trinary`. A pixel's darkness
// above occupied_thresh is occupied, below free_thresh free, between them unknown. Errors name the
// file, and the key or what is wrong with the picture.
[[nodiscard]] Result<OccupancyGrid> loadChart(const std::string& yaml_path);

// Writes NAME.yaml and NAME.pgm beside it for `yaml_path` = NAME.yaml; loadChart() reads it back
// to the same grid.
[[nodiscard]] Status saveChart(const OccupancyGrid& grid, const std::string& yaml_path);

// Heights over the water, m, of what a vessel must mind.
struct HeightBand {
  double min_m = 0.1;
  double max_m = 2.0;
};

// The projection of an OctoMap tree (.bt or .ot): a column with an occupied voxel within `band` is
// occupied, with only free ones free, without any unknown.
[[nodiscard]] Result<OccupancyGrid> loadOctomap(const std::string& path, const HeightBand& band);

// loadChart() or loadOctomap() by the file's ending (.yaml, .yml, .bt, .ot).
[[nodiscard]] Result<OccupancyGrid> loadMap(const std::string& path, const HeightBand& band);

// What is met this near to charted land is the land's: charts and echoes agree to about two cells.
constexpr double kCoastM = 0.6;
// Of each cell whether it is charted land or that near to it.
[[nodiscard]] std::vector<bool> coastOf(const OccupancyGrid& chart);

}  // namespace otter_nav::map
