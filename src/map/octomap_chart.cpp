#include <algorithm>
#include <cmath>
#include <filesystem>

#include "image.hpp"
#include "octree_file.hpp"
#include "otter_nav/map/chart.hpp"

namespace otter_nav::map {
namespace {

// The plane extent of the tree as a grid of unknown cells, aligned with its voxels.
Result<OccupancyGrid> emptyProjection(const octomap::OcTree& tree, const std::string& path) {
  double low[3];
  double high[3];
  tree.getMetricMin(low[0], low[1], low[2]);
  tree.getMetricMax(high[0], high[1], high[2]);
  const double resolution = tree.getResolution();
  const auto width = std::lround((high[0] - low[0]) / resolution);
  const auto height = std::lround((high[1] - low[1]) / resolution);
  if (const Status size = checkImageSize(width, height, path); !size) {
    return failure(size.error().message);
  }
  OccupancyGrid grid;
  grid.geometry = {static_cast<int>(width), static_cast<int>(height), resolution, {low[0], low[1]}};
  grid.cells.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                    Cell::kUnknown);
  return grid;
}

}  // namespace

Result<OccupancyGrid> loadOctomap(const std::string& path, const HeightBand& band) {
  const Result<std::unique_ptr<octomap::OcTree>> tree = readOctree(path);
  if (!tree) {
    return failure(tree.error().message);
  }
  if ((*tree)->size() == 0) {
    return failure(path + ": the tree is empty");
  }
  Result<OccupancyGrid> grid = emptyProjection(**tree, path);
  if (!grid) {
    return grid;
  }
  const GridGeometry& g = grid->geometry;
  for (auto leaf = (*tree)->begin_leafs(), end = (*tree)->end_leafs(); leaf != end; ++leaf) {
    const double half = 0.5 * leaf.getSize();
    if (leaf.getZ() - half >= band.max_m || leaf.getZ() + half <= band.min_m) {
      continue;
    }
    const bool occupied = (*tree)->isNodeOccupied(*leaf);
    const auto x0 = std::lround((leaf.getX() - half - g.origin.x()) / g.resolution_m);
    const auto y0 = std::lround((leaf.getY() - half - g.origin.y()) / g.resolution_m);
    const auto side = std::lround(leaf.getSize() / g.resolution_m);
    for (long y = std::max(0L, y0); y < std::min<long>(g.height, y0 + side); ++y) {
      for (long x = std::max(0L, x0); x < std::min<long>(g.width, x0 + side); ++x) {
        Cell& cell = grid->cells[g.index(static_cast<int>(x), static_cast<int>(y))];
        cell = occupied || cell == Cell::kOccupied ? Cell::kOccupied : Cell::kFree;
      }
    }
  }
  return grid;
}

Result<OccupancyGrid> loadMap(const std::string& path, const HeightBand& band) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".yaml" || ending == ".yml") {
    return loadChart(path);
  }
  if (ending == ".bt" || ending == ".ot") {
    return loadOctomap(path, band);
  }
  return failure(path + ": maps end in .yaml, .yml, .bt or .ot");
}

}  // namespace otter_nav::map
