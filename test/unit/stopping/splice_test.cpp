// What a trajectory's pieces say of its rests.
#include "otter_nav/stopping/splice.hpp"

#include <gtest/gtest.h>

#include "otter_nav/trajectory/polynomial/hermite.hpp"
#include "otter_nav/trajectory/straight_leg.hpp"

namespace otter_nav::stopping {
namespace {

trajectory::Piece leg(double from_m, double to_m) {
  vessel::FlatPoint from;
  vessel::FlatPoint to;
  from.position.x() = from_m;
  to.position.x() = to_m;
  return trajectory::hermitePiece(from, to, 10.0);
}

trajectory::Piece turn(double at_m) {
  return trajectory::spinPiece({at_m, 0.0}, 0.0, 1.0, 4.0);
}

TEST(RestsBeforeItsEnd, WhereItSailsOn) {
  EXPECT_FALSE(restsBeforeItsEnd(trajectory::Trajectory({turn(0.0), leg(0.0, 10.0)})));
  EXPECT_TRUE(
      restsBeforeItsEnd(trajectory::Trajectory({leg(0.0, 10.0), turn(10.0), leg(10.0, 20.0)})));
  EXPECT_TRUE(restsBeforeItsEnd(trajectory::Trajectory({leg(0.0, 10.0), leg(10.0, 20.0)})));
}

// The turn at the goal sets a hull aside that no thruster holds.
TEST(RestsBeforeItsEnd, NotWhereItTurnsAtTheGoal) {
  trajectory::Piece drifting = turn(10.0);
  drifting.position(1, 3) = 1e-3;
  const trajectory::Trajectory arrives({leg(0.0, 10.0), drifting});
  ASSERT_GT(arrives.flat(arrives.duration() - 1.0).velocity.norm(), 1e-3);
  EXPECT_FALSE(restsBeforeItsEnd(arrives));
}

// Creeping, the legs have a heading of their own too.
TEST(RestsBeforeItsEnd, WhereItCreepsOn) {
  const auto creeps = [](double from_m, double ahead_m) {
    return trajectory::straightLeg({from_m, 0.0}, 0.0, ahead_m, 6.0);
  };
  EXPECT_TRUE(
      restsBeforeItsEnd(trajectory::Trajectory({creeps(0.0, 3.0), turn(3.0), creeps(3.0, -2.0)})));
  EXPECT_FALSE(restsBeforeItsEnd(trajectory::Trajectory({creeps(0.0, 3.0), turn(3.0)})));
}

}  // namespace
}  // namespace otter_nav::stopping
