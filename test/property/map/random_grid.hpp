// Seeded maps for the property tests: blobs, walls and single cells.
#pragma once

#include <algorithm>
#include <cmath>

#include "otter_nav/base/random.hpp"
#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::map {

inline int randomBelow(Random& random, int limit) {
  return static_cast<int>(random.uniform(0.0, limit));
}

inline void drawRandomRectangle(OccupancyGrid& grid, Random& random, int largest, Cell cell) {
  const int x0 = randomBelow(random, grid.geometry.width);
  const int y0 = randomBelow(random, grid.geometry.height);
  const int x1 = std::min(grid.geometry.width, x0 + 1 + randomBelow(random, largest));
  const int y1 = std::min(grid.geometry.height, y0 + 1 + randomBelow(random, largest));
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      grid.cells[grid.geometry.index(x, y)] = cell;
    }
  }
}

inline OccupancyGrid randomGrid(Random& random, int width, int height, int obstacles) {
  OccupancyGrid grid;
  grid.geometry = {width, height, 0.25, {random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0)}};
  grid.cells.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                    Cell::kFree);
  for (int i = 0; i < obstacles; ++i) {
    drawRandomRectangle(grid, random, i % 2 == 0 ? 1 : 9, Cell::kOccupied);
  }
  return grid;
}

// The distance from p to the nearest occupied square or the map's outside, by looking at all.
inline double bruteForceClearance(const OccupancyGrid& grid, const Eigen::Vector2d& p) {
  const GridGeometry& g = grid.geometry;
  if (!g.contains(p)) {
    return 0.0;
  }
  const Eigen::Vector2d size(g.width * g.resolution_m, g.height * g.resolution_m);
  const Eigen::Vector2d local = p - g.origin;
  double best = std::min(local.minCoeff(), (size - local).minCoeff());
  for (int y = 0; y < g.height; ++y) {
    for (int x = 0; x < g.width; ++x) {
      if (grid.at(x, y) == Cell::kOccupied) {
        const Eigen::Vector2d away =
            (p - g.centreOf(x, y)).cwiseAbs() - Eigen::Vector2d::Constant(0.5 * g.resolution_m);
        best = std::min(best, away.cwiseMax(0.0).norm());
      }
    }
  }
  return best;
}

inline Eigen::Vector2d randomPoint(Random& random, const GridGeometry& g) {
  return g.origin + g.resolution_m * Eigen::Vector2d(random.uniform(0.0, g.width),
                                                     random.uniform(0.0, g.height));
}

}  // namespace otter_nav::map
