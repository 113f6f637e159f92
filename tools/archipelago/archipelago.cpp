#include "archipelago/archipelago.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::scenario {
namespace {

using map::Cell;
using map::OccupancyGrid;

constexpr double kReferenceSizeM = 300.0;  // the counts are per this square

// Calls `inside(p)` for each cell's centre in the square around `centre` and fills where it holds.
template <typename Inside>
void fill(OccupancyGrid& grid, const Eigen::Vector2d& centre, double reach_m,
          const Inside& inside) {
  const map::GridGeometry& geometry = grid.geometry;
  const double cell = geometry.resolution_m;
  const Eigen::Vector2d low = (centre - geometry.origin).array() - reach_m;
  const Eigen::Vector2d high = (centre - geometry.origin).array() + reach_m;
  const int first_column = std::max(0, static_cast<int>(low.x() / cell));
  const int last_column = std::min(geometry.width - 1, static_cast<int>(high.x() / cell));
  const int first_row = std::max(0, static_cast<int>(low.y() / cell));
  const int last_row = std::min(geometry.height - 1, static_cast<int>(high.y() / cell));
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      if (inside(Eigen::Vector2d(geometry.centreOf(column, row) - centre))) {
        grid.cells[geometry.index(column, row)] = Cell::kOccupied;
      }
    }
  }
}

Eigen::Vector2d anywhere(const OccupancyGrid& grid, Random& random) {
  const map::GridGeometry& geometry = grid.geometry;
  const double x = random.uniform(0.0, geometry.width * geometry.resolution_m);
  const double y = random.uniform(0.0, geometry.height * geometry.resolution_m);
  return geometry.origin + Eigen::Vector2d(x, y);
}

// A coastline: a circle whose radius varies by a few harmonics of the bearing.
class Coastline {
 public:
  Coastline(double radius_m, Random& random) : radius_m_(radius_m) {
    for (std::size_t k = 0; k < kHarmonics; ++k) {
      amplitude_[k] = 0.25 * random.normal() / static_cast<double>(k + 1);
      phase_[k] = random.uniform(-kPi, kPi);
    }
  }
  [[nodiscard]] bool inside(const Eigen::Vector2d& p) const {
    const double bearing = angleOf(p);
    double share = 1.0;
    for (std::size_t k = 0; k < kHarmonics; ++k) {
      share += amplitude_[k] * std::cos(static_cast<double>(k + 2) * bearing + phase_[k]);
    }
    return p.norm() < radius_m_ * std::clamp(share, 0.3, kLargest);
  }
  [[nodiscard]] double reach() const { return kLargest * radius_m_; }

 private:
  static constexpr std::size_t kHarmonics = 7;
  static constexpr double kLargest = 2.0;
  double radius_m_;
  std::array<double, kHarmonics> amplitude_{};
  std::array<double, kHarmonics> phase_{};
};

void drawIsland(OccupancyGrid& grid, Random& random) {
  // Many islets, few islands.
  const double share = random.uniform();
  const Coastline coast(5.0 + 15.0 * share * share, random);
  fill(grid, anywhere(grid, random), coast.reach(),
       [&](const Eigen::Vector2d& p) { return coast.inside(p); });
}

void drawBar(OccupancyGrid& grid, double length_m, double width_m, Random& random) {
  const double psi = random.uniform(-kPi, kPi);
  const Eigen::Vector2d along = unitVector(psi);
  fill(grid, anywhere(grid, random), 0.5 * std::hypot(length_m, width_m),
       [&](const Eigen::Vector2d& p) {
         const double across = cross(along, p);
         return std::abs(along.dot(p)) < 0.5 * length_m && std::abs(across) < 0.5 * width_m;
       });
}

// A buoy, or every third time a pontoon.
void drawFloating(OccupancyGrid& grid, Random& random) {
  if (random.uniform() < 1.0 / 3.0) {
    const double length = random.uniform(3.0, 9.0);
    drawBar(grid, length, random.uniform(1.0, 3.0), random);
    return;
  }
  const double radius = random.uniform(0.3, 1.25);
  fill(grid, anywhere(grid, random), radius,
       [&](const Eigen::Vector2d& p) { return p.norm() < radius; });
}

int scaled(double count, const ArchipelagoOptions& options) {
  const double share = options.size_m / kReferenceSizeM;
  return static_cast<int>(std::lround(count * share * share));
}

Status inRange(const char* what, double value, double min, double max) {
  if (std::isfinite(value) && value >= min && value <= max) {
    return {};
  }
  return failure("archipelago: " + std::string(what) + " = " + std::to_string(value) +
                 " is outside [" + std::to_string(min) + ", " + std::to_string(max) + "]");
}

}  // namespace

Status check(const ArchipelagoOptions& options) {
  constexpr double kMany = 2000.0;
  const std::array<Status, 11> checks = {
      inRange("size", options.size_m, 20.0, 2000.0),
      inRange("cell", options.resolution_m, 0.05, 2.0),
      inRange("cells across", options.size_m / options.resolution_m, 20.0, 8000.0),
      inRange("islands", options.islands, 0.0, kMany),
      inRange("breakwaters", options.breakwaters, 0.0, kMany),
      inRange("charted obstacles", options.charted, 0.0, kMany),
      inRange("uncharted obstacles", options.uncharted, 0.0, kMany),
      inRange("local missions", options.local_missions, 0.0, 1000.0),
      inRange("cross missions", options.cross_missions, 0.0, 1000.0),
      inRange("vessels", options.vessels, 0.0, 100.0),
      inRange("local distance", options.local_distance_m, 1.0, 1.4 * options.size_m)};
  for (const Status& status : checks) {
    if (!status) {
      return status;
    }
  }
  return {};
}

OccupancyGrid drawChart(const ArchipelagoOptions& options, Random& random) {
  OccupancyGrid grid;
  const int cells = static_cast<int>(std::lround(options.size_m / options.resolution_m));
  grid.geometry.width = cells;
  grid.geometry.height = cells;
  grid.geometry.resolution_m = options.resolution_m;
  grid.geometry.origin.setConstant(-0.5 * options.size_m);
  grid.cells.assign(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells), Cell::kFree);
  if (options.walls != Walls::kNone) {
    drawWalls(options.walls, random, grid);
    return grid;
  }
  for (int k = 0; k < scaled(options.islands, options); ++k) {
    drawIsland(grid, random);
  }
  for (int k = 0; k < scaled(options.breakwaters, options); ++k) {
    drawBar(grid, random.uniform(10.0, 40.0), 1.0, random);
  }
  for (int k = 0; k < scaled(options.charted, options); ++k) {
    drawFloating(grid, random);
  }
  return grid;
}

void drawUncharted(const ArchipelagoOptions& options, Random& random, OccupancyGrid& world) {
  if (options.walls != Walls::kNone) {
    return;
  }
  for (int k = 0; k < scaled(options.uncharted, options); ++k) {
    drawFloating(world, random);
  }
}

Result<Archipelago> generateArchipelago(const ArchipelagoOptions& options, std::uint64_t seed) {
  if (const Status status = check(options); !status) {
    return failure(status.error().message);
  }
  Random random(seed);
  Archipelago archipelago;
  archipelago.chart = drawChart(options, random);
  archipelago.world = archipelago.chart;
  drawUncharted(options, random, archipelago.world);
  Result<std::vector<Mission>> missions = chooseMissions(archipelago.world, options, random);
  if (!missions) {
    return failure(missions.error().message);
  }
  archipelago.missions = std::move(*missions);
  Result<std::vector<vessel::ScriptedVessel>> vessels =
      chooseRoutes(archipelago.world, archipelago.missions, options, random);
  if (!vessels) {
    return failure(vessels.error().message);
  }
  archipelago.vessels = std::move(*vessels);
  return archipelago;
}

}  // namespace otter_nav::scenario
