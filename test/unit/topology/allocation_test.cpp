#include <gtest/gtest.h>

#include "../counted_allocations.hpp"
#include "otter_nav/topology/guide_path.hpp"

namespace otter_nav::topology {
namespace {

TEST(GuidePathFinder, AllocatesNothingOnceItKnowsTheMap) {
  map::OccupancyGrid grid;
  grid.geometry = {240, 240, 0.25, {-30.0, -30.0}};
  grid.cells.assign(240UL * 240UL, map::Cell::kFree);
  for (int column = 100; column < 140; ++column) {
    for (int row = 60; row < 200; ++row) {
      grid.cells[grid.geometry.index(column, row)] = map::Cell::kOccupied;
    }
  }
  const map::DistanceField field(grid, {});
  GuidePathFinder finder({});
  GuidePath path;
  const Pose start{{-20.0, 0.0}, 0.0};
  const Pose goal{{20.0, 5.0}, 1.0};
  ASSERT_TRUE(finder.find(field, start, goal, path));
  const int before = test::allocations;
  ASSERT_TRUE(finder.find(field, start, goal, path));
  EXPECT_EQ(test::allocations, before);
}

}  // namespace
}  // namespace otter_nav::topology
