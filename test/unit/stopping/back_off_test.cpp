#include "otter_nav/stopping/back_off.hpp"

#include <gtest/gtest.h>

#include "../mission/waters.hpp"
#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/trajectory/straight_leg.hpp"
#include "otter_nav/vessel/rest.hpp"

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
  const auto way = backOff(restAt(0.0, 0.0, 0.0), field, otter, {});
  ASSERT_TRUE(way);
  const trajectory::Sample end = way->sample(way->duration(), otter);
  EXPECT_LT(end.state.x(), -0.2);
  EXPECT_NEAR(end.state.y(), 0.0, 1e-9);
  EXPECT_NEAR(end.state[vessel::kPsi], 0.0, 1e-9);
  EXPECT_LT(end.state.tail<3>().norm(), 1e-9);
  EXPECT_GE(field.clearance(end.state.head<2>()), turningRoom(otter.hull));
}

// Waves may have set it nearer to something than it would go by itself: away from there, and no
// nearer.
TEST(BackOff, GoesFromWhereItAllButTouches) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {1.3, -10.0}, {2.0, 10.0});
  test::block(grid, {-3.0, 1.0}, {-0.5, 2.0});
  const map::DistanceField field = test::fieldOf(grid);
  const vessel::Parameters otter;
  const auto left = [&](double y) {
    return feasibility::outlineClearance(
        otter.hull, {0.0, y}, 0.0, [&](const Eigen::Vector2d& p) { return field.clearance(p); });
  };
  double y = 0.0;
  while (left(y) > 0.015) {
    y += 0.001;
  }
  ASSERT_GT(left(y), 0.01);
  const auto way = backOff(restAt(0.0, y, 0.0), field, otter, {});
  ASSERT_TRUE(way);
  EXPECT_TRUE(backOffIsClear(*way, 0.0, field, otter));
  // Nearer still it comes on another line.
  vessel::State nearer = restAt(0.0, y, 0.0);
  const trajectory::Trajectory into({trajectory::straightLeg(nearer.head<2>(), 0.3, 1.0, 4.0)});
  EXPECT_FALSE(backOffIsClear(into, 0.0, field, otter));
}

TEST(BackOff, GoesAheadWhereTheWallIsAstern) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {-2.0, -10.0}, {-1.3, 10.0});
  const auto way = backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), vessel::Parameters{}, {});
  ASSERT_TRUE(way);
  EXPECT_GT(way->flat(way->duration()).position.x(), 0.2);
}

TEST(BackOff, StaysWhereThereIsRoomOrNoWayOut) {
  map::OccupancyGrid grid = test::openWater();
  const vessel::Parameters otter;
  EXPECT_FALSE(backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), otter, {}));
  test::block(grid, {-30.0, 0.9}, {30.0, 2.0});  // a canal along the heading
  test::block(grid, {-30.0, -2.0}, {30.0, -0.9});
  EXPECT_FALSE(backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), otter, {}));
}

TEST(BackOff, StaysWhereTheWindWouldSetItAgainstTheWall) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {1.3, -10.0}, {2.0, 10.0});
  test::block(grid, {-1.5, 0.9}, {1.3, 2.0});
  const vessel::Parameters otter;
  vessel::Disturbance abeam;
  abeam.force_n = {0.0, 20.0};
  EXPECT_TRUE(backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), otter, {}));
  EXPECT_FALSE(backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), otter, abeam));
}

// What carries it off what lies beside it is no reason to stay.
TEST(BackOff, GoesWhereTheWindSetsItOffTheWall) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {1.3, -10.0}, {2.0, 10.0});
  test::block(grid, {-1.5, 0.9}, {1.3, 2.0});
  const vessel::Parameters otter;
  vessel::Disturbance abeam;
  abeam.force_n = {0.0, -20.0};
  EXPECT_TRUE(backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), otter, abeam));
}

// On a heading that can be held the tracker holds it: a slow drift towards what lies beside it is
// not counted for all the time a leg takes, nor on top of what it wanders.
TEST(BackOff, GoesWhereASlowDriftIsHeld) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {1.3, -10.0}, {2.0, 10.0});
  test::block(grid, {-1.5, 0.88}, {1.3, 2.0});
  const vessel::Parameters otter;
  vessel::Disturbance abeam;
  while (vessel::setAside(otter.manoeuvring, abeam, 0.0) < 0.15) {
    abeam.force_n.y() += 0.1;
  }
  constexpr double kReachM = 0.13;
  EXPECT_TRUE(backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), otter, abeam, kReachM));
  while (vessel::canLie(otter.manoeuvring, abeam, 0.0)) {
    abeam.force_n.y() += 0.1;
  }
  EXPECT_FALSE(backOff(restAt(0.0, 0.0, 0.0), test::fieldOf(grid), otter, abeam, kReachM));
}

// A hull twice as long needs more room to turn, and gets it.
TEST(BackOff, GoesFurtherWithALongerHull) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {2.75, -10.0}, {3.5, 10.0});
  const map::DistanceField field = test::fieldOf(grid);
  vessel::Parameters wam_v;
  wam_v.hull = {4.9, 2.44};
  wam_v.thrusters.ahead_max_n = 1000.0;
  wam_v.thrusters.astern_max_n = 400.0;
  const auto way = backOff(restAt(0.0, 0.0, 0.0), field, wam_v, {});
  ASSERT_TRUE(way);
  EXPECT_GE(field.clearance(way->flat(way->duration()).position), turningRoom(wam_v.hull));
}

TEST(TurnBack, ComesIntoTheMapWithRoomToTurn) {
  const map::DistanceField field = test::fieldOf(test::openWater());  // to x = 50 m
  const vessel::Parameters otter;
  for (const double psi : {0.0, 0.7, 1.6, -2.5, 3.1}) {
    const vessel::State start = restAt(51.0, 3.0, psi);
    const auto way = turnBack(start, field, otter);
    ASSERT_TRUE(way) << psi;
    EXPECT_LT((way->sample(0.0, otter).state - start).norm(), 1e-9) << psi;
    const vessel::State end = way->sample(way->duration(), otter).state;
    EXPECT_GE(field.clearance(end.head<2>()), turningRoom(otter.hull)) << psi;
    EXPECT_LT(end.tail<3>().norm(), 1e-9) << psi;
    EXPECT_LT(std::abs(end.y() - 3.0), 1.0) << psi;  // the shortest way
  }
}

TEST(TurnBack, IsBlockedByWhatIsNearerThanTheEdge) {
  map::OccupancyGrid grid = test::openWater();
  const vessel::Parameters otter;
  const auto way = turnBack(restAt(51.0, 3.0, 0.0), test::fieldOf(grid), otter);
  ASSERT_TRUE(way);
  EXPECT_TRUE(turnBackIsClear(*way, 0.0, test::fieldOf(grid), otter));
  test::block(grid, {47.0, 2.5}, {47.9, 3.5});
  EXPECT_FALSE(turnBackIsClear(*way, 0.0, test::fieldOf(grid), otter));
}

TEST(TurnBack, GoesAroundWhatLiesInsideTheEdgeOrStays) {
  map::OccupancyGrid grid = test::openWater();
  test::block(grid, {44.0, 1.0}, {49.0, 5.0});
  const map::DistanceField field = test::fieldOf(grid);
  const vessel::Parameters otter;
  const auto way = turnBack(restAt(51.0, 3.0, 0.0), field, otter);
  ASSERT_TRUE(way);
  EXPECT_TRUE(turnBackIsClear(*way, 0.0, field, otter));
  EXPECT_GE(field.clearance(way->flat(way->duration()).position), turningRoom(otter.hull));
  test::block(grid, {35.0, -49.9}, {49.5, 49.9});
  EXPECT_FALSE(turnBack(restAt(51.0, 3.0, 0.0), test::fieldOf(grid), otter));
}

}  // namespace
}  // namespace otter_nav::stopping
