#include "otter_nav/map/distance_field.hpp"

#include <gtest/gtest.h>

#include "random_grid.hpp"

namespace otter_nav::map {
namespace {

constexpr double kTightness_m = 0.15 * 0.25;

TEST(DistanceFieldProperty, ClearanceIsATightLowerBound) {
  Random random(1);
  double worst = 0.0;
  for (int round = 0; round < 60; ++round) {
    const OccupancyGrid grid = randomGrid(random, 40 + round, 70 - round / 2, 2 + round);
    const DistanceField field(grid, {4.0, false});
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector2d p = randomPoint(random, grid.geometry);
      const double truth = std::min(4.0, bruteForceClearance(grid, p));
      const double bound = field.clearance(p);
      ASSERT_LE(bound, truth + 1e-9) << "round " << round << " at " << p.transpose();
      ASSERT_GE(bound, truth - kTightness_m) << "round " << round << " at " << p.transpose();
      worst = std::max(worst, truth - bound);
    }
  }
  RecordProperty("worst_loss_mm", static_cast<int>(1e3 * worst));
}

TEST(DistanceFieldProperty, IsClearAgreesWithClearance) {
  Random random(2);
  for (int round = 0; round < 20; ++round) {
    const OccupancyGrid grid = randomGrid(random, 60, 50, 5 + round);
    const DistanceField field(grid, {4.0, false});
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector2d p = randomPoint(random, grid.geometry);
      const double truth = bruteForceClearance(grid, p);
      const double asked = random.uniform(0.0, 3.0);
      if (field.isClear(p, asked)) {
        ASSERT_GE(truth, asked);
      } else {
        ASSERT_LE(truth, asked + kTightness_m);
      }
    }
  }
}

TEST(DistanceFieldProperty, WindowedUpdateEqualsRebuild) {
  Random random(3);
  for (int round = 0; round < 40; ++round) {
    OccupancyGrid grid = randomGrid(random, 90, 110, 12);
    const DistanceFieldOptions options{2.5, false};
    DistanceField updated(grid, options);
    for (int change = 0; change < 4; ++change) {
      const int x = randomBelow(random, 90);
      const int y = randomBelow(random, 110);
      const int width = 1 + randomBelow(random, 20);
      const int height = 1 + randomBelow(random, 20);
      for (int row = y; row < std::min(110, y + height); ++row) {
        for (int column = x; column < std::min(90, x + width); ++column) {
          grid.cells[grid.geometry.index(column, row)] =
              random.uniform() < 0.1 ? Cell::kOccupied : Cell::kFree;
        }
      }
      updated.update(grid, {x, y, width, height});
    }
    const DistanceField rebuilt(grid, options);
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector2d p = randomPoint(random, grid.geometry);
      ASSERT_EQ(updated.clearance(p), rebuilt.clearance(p)) << "round " << round;
      ASSERT_EQ(updated.smooth(p).distance_m, rebuilt.smooth(p).distance_m) << "round " << round;
    }
  }
}

TEST(DistanceFieldProperty, SmoothHasItsGradientAndTheClearancesSize) {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    const OccupancyGrid grid = randomGrid(random, 60, 60, 10);
    const DistanceField field(grid, {4.0, false});
    for (int i = 0; i < 300; ++i) {
      const GridGeometry& g = grid.geometry;
      // Well inside a cell, where the bilinear patch is differentiable.
      const Eigen::Vector2d p =
          g.centreOf(randomBelow(random, 60), randomBelow(random, 60)) +
          0.25 * Eigen::Vector2d(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4));
      const auto here = field.smooth(p);
      if (here.distance_m > 3.9) {
        continue;
      }
      const double h = 1e-6;
      for (int axis = 0; axis < 2; ++axis) {
        const Eigen::Vector2d step = h * Eigen::Vector2d::Unit(axis);
        const double slope =
            (field.smooth(p + step).distance_m - field.smooth(p - step).distance_m) / (2.0 * h);
        ASSERT_NEAR(here.gradient[axis], slope, 1e-6);
      }
      const double truth = bruteForceClearance(grid, p);
      ASSERT_NEAR(std::max(0.0, here.distance_m), truth, 0.25);
    }
  }
}

TEST(SegmentIsClearProperty, AgreesWithDenseSampling) {
  Random random(5);
  int clear = 0;
  for (int round = 0; round < 30; ++round) {
    const OccupancyGrid grid = randomGrid(random, 60, 60, 8);
    const DistanceField field(grid, {4.0, false});
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector2d a = randomPoint(random, grid.geometry);
      const Eigen::Vector2d b = randomPoint(random, grid.geometry);
      const double asked = random.uniform(0.1, 1.0);
      double least = 1e9;
      const int samples = 60;
      for (int k = 0; k <= samples; ++k) {
        least = std::min(least, bruteForceClearance(grid, a + (b - a) * k / samples));
      }
      const bool said = segmentIsClear(field, a, b, asked);
      clear += said ? 1 : 0;
      if (said) {
        ASSERT_GE(least, asked - 1e-9);
      } else {  // samples stand half a step from the worst place at most
        ASSERT_LE(least, asked + kTightness_m + 0.5 * (b - a).norm() / samples);
      }
    }
  }
  EXPECT_GT(clear, 100);
}

}  // namespace
}  // namespace otter_nav::map
