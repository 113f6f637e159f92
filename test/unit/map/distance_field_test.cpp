#include "otter_nav/map/distance_field.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace otter_nav::map {
namespace {

// 40 m by 20 m from (-10, -5), 0.25 m a cell, with a block over [0, 2) x [0, 1).
OccupancyGrid blockGrid() {
  OccupancyGrid grid;
  grid.geometry = {160, 80, 0.25, {-10.0, -5.0}};
  grid.cells.assign(160UL * 80UL, Cell::kFree);
  for (int row = 20; row < 24; ++row) {
    for (int column = 40; column < 48; ++column) {
      grid.cells[grid.geometry.index(column, row)] = Cell::kOccupied;
    }
  }
  return grid;
}

TEST(DistanceField, MeasuresToTheSquaresSides) {
  const DistanceField field(blockGrid(), {4.0, false});
  EXPECT_NEAR(field.clearance({1.0, 2.0}), 1.0, 0.02);
  EXPECT_NEAR(field.clearance({-1.5, 0.5}), 1.5, 0.02);
  EXPECT_NEAR(field.clearance({5.0, 5.0}), 4.0, 1e-9);  // saturated
  EXPECT_EQ(field.clearance({1.0, 0.5}), 0.0);          // inside
  EXPECT_EQ(field.clearance({-10.1, 0.0}), 0.0);        // outside the map
  EXPECT_EQ(field.clearance({std::nan(""), 0.0}), 0.0);
  EXPECT_NEAR(field.clearance({-9.0, 4.0}), 1.0, 0.02);  // the border is an obstacle
}

TEST(DistanceField, TellsTheCornersOfOutlines) {
  OccupancyGrid grid;
  grid.geometry = {20, 20, 0.5, {0.0, 0.0}};
  grid.cells.assign(400, Cell::kFree);
  for (int row = 5; row < 9; ++row) {
    for (int column = 6; column < 11; ++column) {
      grid.cells[grid.geometry.index(column, row)] = Cell::kOccupied;
    }
  }
  const DistanceField field(grid, {});
  for (int row = 1; row < 20; ++row) {
    for (int column = 1; column < 20; ++column) {
      const bool within = column >= 6 && column <= 11 && row >= 5 && row <= 9;
      const bool inside = column > 6 && column < 11 && row > 5 && row < 9;
      EXPECT_EQ(field.isOnOutline(column, row), within && !inside) << column << " " << row;
    }
  }
}

TEST(DistanceField, SmoothIsNegativeInsideAndPointsOut) {
  const DistanceField field(blockGrid(), {4.0, false});
  EXPECT_NEAR(field.smooth({1.0, 2.0}).distance_m, 1.0, 1e-6);
  EXPECT_NEAR(field.smooth({1.0, 2.0}).gradient.y(), 1.0, 1e-6);
  const auto inside = field.smooth({0.9, 0.8});
  EXPECT_NEAR(inside.distance_m, -0.2, 1e-6);
  EXPECT_GT(inside.gradient.y(), 0.9);
  const auto outside = field.smooth({-11.0, 0.0});
  EXPECT_NEAR(outside.distance_m, -1.0, 1e-9);
  EXPECT_NEAR(outside.gradient.x(), 1.0, 1e-9);
}

TEST(DistanceField, UnknownCellsAsTold) {
  OccupancyGrid grid = blockGrid();
  for (Cell& cell : grid.cells) {
    cell = cell == Cell::kOccupied ? Cell::kUnknown : cell;
  }
  EXPECT_GT(DistanceField(grid, {4.0, false}).clearance({1.0, 0.5}), 3.0);
  EXPECT_EQ(DistanceField(grid, {4.0, true}).clearance({1.0, 0.5}), 0.0);
}

// As a rebuild with the cells occupied; over the map's edge only what lies inside.
TEST(DistanceField, OccupiesADisc) {
  const Eigen::Vector2d places[] = {{-4.0, 2.1}, {29.9, 14.9}, {-12.0, 0.0}, {100.0, 0.0}};
  OccupancyGrid grid = blockGrid();
  DistanceField field(grid, {4.0, false});
  for (const Eigen::Vector2d& place : places) {
    constexpr double kRadiusM = 0.9;
    field.occupy(place, kRadiusM);
    for (int row = 0; row < grid.geometry.height; ++row) {
      for (int column = 0; column < grid.geometry.width; ++column) {
        const Eigen::Vector2d middle =
            grid.geometry.origin + 0.25 * Eigen::Vector2d(column + 0.5, row + 0.5);
        if ((middle - place).norm() <= kRadiusM) {
          grid.cells[grid.geometry.index(column, row)] = Cell::kOccupied;
        }
      }
    }
    const DistanceField rebuilt(grid, {4.0, false});
    for (double x = -10.0; x < 30.0; x += 0.33) {
      for (double y = -5.0; y < 15.0; y += 0.31) {
        ASSERT_EQ(field.clearance({x, y}), rebuilt.clearance({x, y})) << x << " " << y;
      }
    }
  }
  EXPECT_EQ(field.clearance({-4.0, 2.0}), 0.0);
}

TEST(SegmentIsClear, GrazesWithoutClipping) {
  const DistanceField field(blockGrid(), {4.0, false});
  EXPECT_TRUE(segmentIsClear(field, {-5.0, 1.81}, {8.0, 1.81}, 0.8));
  EXPECT_FALSE(segmentIsClear(field, {-5.0, 1.79}, {8.0, 1.79}, 0.8));
  EXPECT_FALSE(segmentIsClear(field, {-5.0, 0.5}, {8.0, 0.5}, 0.1));
  EXPECT_TRUE(segmentIsClear(field, {5.0, 5.0}, {5.0, 5.0}, 0.8));
  // Past the corner (2, 1) at 45 degrees: 0.8 m away is 0.8 sqrt(2) along the diagonal.
  const double reach = 3.0 + 0.8 * std::sqrt(2.0);
  EXPECT_TRUE(
      segmentIsClear(field, {reach - 2.99, 2.99 + 0.01}, {2.99 + 0.01, reach - 2.99}, 0.79));
  EXPECT_FALSE(segmentIsClear(field, {reach - 3.0, 3.0}, {3.0, reach - 3.0}, 0.81));
  EXPECT_FALSE(segmentIsClear(field, {std::nan(""), 0.0}, {8.0, 4.0}, 0.8));
}

}  // namespace
}  // namespace otter_nav::map
