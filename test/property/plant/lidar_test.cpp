// Ray casting and hull contact against slow, plain versions of themselves.
#include "otter_nav/plant/lidar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/plant/hull_contact.hpp"
#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::plant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

map::OccupancyGrid randomWorld(std::uint64_t seed, double density) {
  map::OccupancyGrid grid;
  grid.geometry = {70, 50, 0.25, Eigen::Vector2d(-3.0, 2.0)};
  grid.cells.resize(70 * 50);
  Random random(seed);
  for (map::Cell& cell : grid.cells) {
    cell = random.uniform() < density ? map::Cell::kOccupied : map::Cell::kFree;
  }
  return grid;
}

// Where the ray enters one cell's square.
double slab(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
            const Eigen::Vector2d& low, double size) {
  double enter = 0.0;
  double leave = kInfinity;
  for (int axis = 0; axis < 2; ++axis) {
    const double a = (low[axis] - from[axis]) / direction[axis];
    const double b = (low[axis] + size - from[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : kInfinity;
}

double castByTryingEveryCell(const map::OccupancyGrid& grid, const Eigen::Vector2d& from,
                             const Eigen::Vector2d& direction, double range) {
  double nearest = kInfinity;
  for (int row = 0; row < grid.geometry.height; ++row) {
    for (int column = 0; column < grid.geometry.width; ++column) {
      if (grid.at(column, row) == map::Cell::kOccupied) {
        const double size = grid.geometry.resolution_m;
        const Eigen::Vector2d low = grid.geometry.origin + size * Eigen::Vector2d(column, row);
        nearest = std::min(nearest, slab(from, direction, low, size));
      }
    }
  }
  return nearest <= range ? nearest : kInfinity;
}

TEST(CastRay, AgreesWithTryingEveryCell) {
  Random random(21);
  for (const double density : {0.002, 0.02, 0.2}) {
    const map::OccupancyGrid grid = randomWorld(random.bits(), density);
    const WorldMap world(grid);
    for (int trial = 0; trial < 300; ++trial) {
      // Some beams start outside the grid.
      const Eigen::Vector2d from(random.uniform(-6.0, 17.0), random.uniform(0.0, 17.0));
      const double angle = random.uniform(-kPi, kPi);
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      const double expected = castByTryingEveryCell(grid, from, direction, 12.0);
      const double found = world.castRay(from, direction, 12.0);
      ASSERT_EQ(std::isinf(found), std::isinf(expected)) << "trial " << trial;
      if (!std::isinf(expected)) {
        ASSERT_NEAR(found, expected, 1e-9) << "trial " << trial;
      }
    }
  }
}

TEST(CastRay, HandlesBeamsAlongTheAxes) {
  map::OccupancyGrid grid = randomWorld(1, 0.0);
  grid.cells[grid.geometry.index(40, 20)] = map::Cell::kOccupied;
  const WorldMap world(grid);
  const Eigen::Vector2d centre = grid.geometry.centreOf(40, 20);
  EXPECT_NEAR(world.castRay(centre - Eigen::Vector2d(5.0, 0.0), {1.0, 0.0}, 25.0), 4.875, 1e-12);
  EXPECT_NEAR(world.castRay(centre + Eigen::Vector2d(5.0, 0.0), {-1.0, 0.0}, 25.0), 4.875, 1e-12);
  EXPECT_NEAR(world.castRay(centre + Eigen::Vector2d(0.0, 3.0), {0.0, -1.0}, 25.0), 2.875, 1e-12);
  EXPECT_TRUE(std::isinf(world.castRay(centre + Eigen::Vector2d(1.0, 3.0), {0.0, -1.0}, 25.0)));
  EXPECT_EQ(world.castRay(centre, {0.0, 1.0}, 25.0), 0.0);
}

Truth levelAt(const Eigen::Vector2d& position, double psi) {
  Truth truth;
  truth.position = {position.x(), position.y(), 0.0};
  truth.yaw_rad = psi;
  truth.planar.head<2>() = position;
  truth.planar[vessel::kPsi] = psi;
  return truth;
}

LidarOptions noiseless() {
  LidarOptions options;
  options.range_noise_m = 0.0;
  options.dropout_probability = 0.0;
  return options;
}

TEST(LidarScan, LevelScanIsTheCastBeams) {
  const map::OccupancyGrid grid = randomWorld(31, 0.02);
  const WorldMap world(grid);
  LidarOptions options = noiseless();
  options.position_m = {0.5, 0.0, 0.8};
  Lidar lidar(options, 1);
  const Truth truth = levelAt({4.0, 8.0}, 0.9);
  const Scan& scan = lidar.scan(world, {}, truth);
  const Eigen::Vector2d eye(4.0 + 0.5 * std::cos(0.9), 8.0 + 0.5 * std::sin(0.9));
  ASSERT_EQ(scan.ranges_m.size(), 720U);
  int hits = 0;
  for (int i = 0; i < 720; ++i) {
    const double angle = 0.9 + scan.angle_min_rad + i * scan.angle_increment_rad;
    const double expected =
        castByTryingEveryCell(grid, eye, {std::cos(angle), std::sin(angle)}, 25.0);
    const float found = scan.ranges_m[static_cast<std::size_t>(i)];
    if (std::isinf(expected)) {
      ASSERT_TRUE(std::isinf(found) && found > 0.0F);
    } else if (expected < options.range_min_m) {
      ASSERT_TRUE(std::isinf(found) && found < 0.0F);
    } else {
      ++hits;
      ASSERT_NEAR(found, expected, 1e-4);
    }
  }
  EXPECT_GT(hits, 100);
}

map::OccupancyGrid wallToTheEast(double distance_m) {
  map::OccupancyGrid grid;
  grid.geometry = {400, 400, 0.25, Eigen::Vector2d(-50.0, -50.0)};
  grid.cells.assign(400 * 400, map::Cell::kFree);
  for (int row = 0; row < 400; ++row) {
    const int column = grid.geometry.cellAt({distance_m + 0.01, 0.0}).x();
    grid.cells[grid.geometry.index(column, row)] = map::Cell::kOccupied;
  }
  return grid;
}

TEST(LidarScan, TiltedBeamsMeetTheWaterFirst) {
  const WorldMap world(wallToTheEast(10.0));
  LidarOptions options = noiseless();
  options.position_m = {0.0, 0.0, 0.8};
  Lidar lidar(options, 1);
  Truth truth = levelAt({0.0, 0.0}, 0.0);
  constexpr std::size_t kAhead = 360;
  EXPECT_NEAR(lidar.scan(world, {}, truth).ranges_m[kAhead], 10.0, 1e-4);
  truth.pitch_rad = 0.07;                   // bow down: water at 11.4 m
  const double eye = 0.8 * std::sin(0.07);  // the mast leans ahead
  EXPECT_NEAR(lidar.scan(world, {}, truth).ranges_m[kAhead], (10.0 - eye) / std::cos(0.07), 1e-4);
  truth.pitch_rad = 0.10;  // water at 8 m
  EXPECT_TRUE(std::isinf(lidar.scan(world, {}, truth).ranges_m[kAhead]));
  truth.pitch_rad = -0.10;  // bow up: over the water to the wall
  EXPECT_TRUE(std::isfinite(lidar.scan(world, {}, truth).ranges_m[kAhead]));
  truth.position.z() = -1.0;  // the eye under water sees nothing
  EXPECT_TRUE(std::isinf(lidar.scan(world, {}, truth).ranges_m[kAhead]));
}

TEST(LidarScan, NoiseAndDropoutsHaveTheirShare) {
  const WorldMap world(wallToTheEast(10.0));
  LidarOptions options = noiseless();
  options.position_m = {0.0, 0.0, 0.8};
  options.range_noise_m = 0.05;
  options.dropout_probability = 0.2;
  Lidar lidar(options, 7);
  const Truth truth = levelAt({0.0, 0.0}, 0.0);
  int lost = 0;
  int hits = 0;
  double variance = 0.0;
  for (int turn = 0; turn < 2000; ++turn) {
    const float range = lidar.scan(world, {}, truth).ranges_m[360];
    lost += std::isnan(range) ? 1 : 0;
    if (std::isfinite(range)) {
      ++hits;
      variance += std::pow(range - 10.0, 2);
    }
  }
  EXPECT_NEAR(lost / 2000.0, 0.2, 0.03);
  EXPECT_NEAR(std::sqrt(variance / hits), 0.05, 0.005);
}

TEST(LidarScan, TooNearIsMinusInfinity) {
  const WorldMap world(wallToTheEast(0.1));
  LidarOptions options = noiseless();
  options.position_m = {0.0, 0.0, 0.8};
  Lidar lidar(options, 7);
  const float range = lidar.scan(world, {}, levelAt({-0.05, 0.0}, 0.0)).ranges_m[360];
  EXPECT_TRUE(std::isinf(range) && range < 0.0F);
}

// Points along the hull's edge and inside it, against points along each cell's edge: an upper bound
// that is tight to the points' spacing.
double clearanceBySampling(const map::OccupancyGrid& grid, const vessel::Hull& hull,
                           const Eigen::Vector2d& position, double psi) {
  constexpr int kPoints = 60;
  const double half = 0.5 * grid.geometry.resolution_m;
  const Eigen::Vector2d ahead(std::cos(psi), std::sin(psi));
  const Eigen::Vector2d port(-ahead.y(), ahead.x());
  double nearest = kInfinity;
  for (int row = 0; row < grid.geometry.height; ++row) {
    for (int column = 0; column < grid.geometry.width; ++column) {
      if (grid.at(column, row) != map::Cell::kOccupied) continue;
      const Eigen::Vector2d centre = grid.geometry.centreOf(column, row);
      if ((centre - position).norm() > nearest + 2.0) continue;
      for (int i = 0; i <= kPoints; ++i) {
        for (int j = 0; j <= kPoints; ++j) {
          const Eigen::Vector2d p =
              position + hull.length_m * (static_cast<double>(i) / kPoints - 0.5) * ahead +
              hull.beam_m * (static_cast<double>(j) / kPoints - 0.5) * port;
          nearest = std::min(
              nearest,
              ((p - centre).cwiseAbs() - Eigen::Vector2d::Constant(half)).cwiseMax(0.0).norm());
        }
      }
    }
  }
  return nearest;
}

TEST(HullClearance, AgreesWithSampledHulls) {
  Random random(41);
  const vessel::Hull hull;
  int touching = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const map::OccupancyGrid grid = randomWorld(random.bits(), 0.004);
    const WorldMap world(grid);
    const Eigen::Vector2d position(random.uniform(-3.0, 14.0), random.uniform(2.0, 14.0));
    const double psi = random.uniform(-kPi, kPi);
    const double sampled = clearanceBySampling(grid, hull, position, psi);
    const double exact = hullClearance(world, hull, position, psi, 50.0);
    EXPECT_LE(exact, sampled + 1e-9);
    EXPECT_GE(exact, sampled - 0.05);
    EXPECT_EQ(hullTouches(world, hull, position, psi), exact == 0.0);
    touching += exact == 0.0 ? 1 : 0;
    EXPECT_EQ(hullClearance(world, hull, position, psi, 0.3), std::min(exact, 0.3));
  }
  EXPECT_GT(touching, 3);
}

}  // namespace
}  // namespace otter_nav::plant
