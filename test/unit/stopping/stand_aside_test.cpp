#include "otter_nav/stopping/stand_aside.hpp"

#include <gtest/gtest.h>

#include "../feasibility/moving_disc.hpp"
#include "../mission/waters.hpp"
#include "otter_nav/stopping/watch.hpp"

namespace otter_nav::stopping {
namespace {

using feasibility::test::MovingDisc;
using mission::test::block;
using mission::test::fieldOf;
using mission::test::openWater;

class StandAside : public testing::Test {
 protected:
  // A disc of 2 m at 1.5 m/s that comes over the vessel, from abeam, in 8 s.
  const MovingDisc comes_{{0.0, -14.0}, {0.0, 1.5}, 2.0};
  const MovingDisc passes_{{12.0, -14.0}, {0.0, 1.5}, 2.0};
  const vessel::Parameters vessel_{};
  const vessel::State state_ = vessel::State::Zero();
};

TEST_F(StandAside, IsCalledForByWhatComesOverHer) {
  const map::DistanceField field = fieldOf(openWater());
  feasibility::Obstacles one(field);
  one.add(comes_);
  EXPECT_TRUE(isRunDown(state_.head<2>(), one, vessel_.hull));
  feasibility::Obstacles other(field);
  other.add(passes_);
  EXPECT_FALSE(isRunDown(state_.head<2>(), other, vessel_.hull));
}

TEST_F(StandAside, GetsOutOfTheWay) {
  const map::DistanceField field = fieldOf(openWater());
  feasibility::Obstacles obstacles(field);
  obstacles.add(comes_);
  const auto way = standAside(state_, obstacles, vessel_);
  ASSERT_TRUE(way.has_value());
  EXPECT_LT(way->flat(way->duration()).velocity.norm(), 1e-6);
  EXPECT_TRUE(std::isinf(firstTouch(*way, 0.0, obstacles, vessel_).after_s));
}

// A wall ahead: astern.
TEST_F(StandAside, TouchesNothingThatLiesStill) {
  map::OccupancyGrid grid = openWater();
  block(grid, {1.6, -20.0}, {2.6, 20.0});
  const map::DistanceField field = fieldOf(grid);
  feasibility::Obstacles obstacles(field);
  obstacles.add(comes_);
  const auto way = standAside(state_, obstacles, vessel_);
  ASSERT_TRUE(way.has_value());
  EXPECT_LT(way->flat(way->duration()).position.x(), -2.0);
}

TEST_F(StandAside, IsNoneWithoutABetterPlace) {
  map::OccupancyGrid grid = openWater();
  block(grid, {1.6, -20.0}, {2.6, 20.0});
  block(grid, {-2.6, -20.0}, {-1.6, 20.0});
  const map::DistanceField field = fieldOf(grid);
  feasibility::Obstacles obstacles(field);
  obstacles.add(comes_);
  EXPECT_FALSE(standAside(state_, obstacles, vessel_).has_value());
}

}  // namespace
}  // namespace otter_nav::stopping
