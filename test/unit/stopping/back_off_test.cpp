#include "otter_nav/stopping/back_off.hpp"

#include <gtest/gtest.h>

#include "../mission/waters.hpp"

namespace otter_nav::stopping {
namespace {

namespace test = mission::test;
vessel::State restAt(double x, double y, double psi) {
  vessel::State state = vessel::State::Zero();
  state << x, y, psi, 0.0, 0.0, 0.0;
  return state;
}

TEST(BackOff, GoesAsternFromAWallAhead) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {1.3, -10.0}, {2.0, 10.0});
  const map::DistanceField field = test::fieldOf(grid);
  const vessel::Parameters otter;
  const auto way = backOff(restAt(0.0, 0.0, 0.0), field, otter, 0.0);
  ASSERT_TRUE(way);
  const trajectory::Sample end = way->sample(way->duration(), otter);
  EXPECT_LT(end.state.x(), -0.2);
  EXPECT_NEAR(end.state.y(), 0.0, 1e-9);
  EXPECT_NEAR(end.state[vessel::kPsi], 0.0, 1e-9);
  EXPECT_LT(end.state.tail<3>().norm(), 1e-9);
  EXPECT_GE(field.clearance(end.state.head<2>()), turningRoom(otter.hull));
}

TEST(BackOff, GoesAheadWhereTheWallIsAstern) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {-2.0, -10.0}, {-1.3, 10.0});
  const auto way = backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), vessel::Parameters{}, 0.0);
  ASSERT_TRUE(way);
  EXPECT_GT(way->flat(way->duration()).position.x(), 0.2);
}

TEST(BackOff, StaysWhereThereIsRoomOrNoWayOut) {
  map::OccupancyGrid grid = test::openWater();
  const vessel::Parameters otter;
  EXPECT_FALSE(backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), otter, 0.0));
  test::block(grid, {-30.0, 0.9}, {30.0, 2.0});  // a canal along the heading
  test::block(grid, {-30.0, -2.0}, {30.0, -0.9});
  EXPECT_FALSE(backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), otter, 0.0));
}

TEST(BackOff, StaysWhereTheWindWouldSetItAgainstTheWall) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {1.3, -10.0}, {2.0, 10.0});
  EXPECT_FALSE(backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), vessel::Parameters{}, 6.0));
}

}  // namespace
}  // namespace otter_nav::stopping
