#include "otter_nav/stopping/braking.hpp"

#include <gtest/gtest.h>

#include "../feasibility/moving_disc.hpp"
#include "../mission/waters.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/stopping/splice.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "otter_nav/trajectory/straight_leg.hpp"

namespace otter_nav::stopping {
namespace {

namespace test = mission::test;
using test::block;
using test::circle;
using test::eastward;
using test::fieldOf;
using test::openWater;
using trajectory::Trajectory;

constexpr double kSpeed = 4.3;
constexpr double kClearanceM = 0.8;

feasibility::Verification verify(const Trajectory& stop, const map::DistanceField& field) {
  auto limits = feasibility::SafetyLimits::of(vessel::Parameters{});
  limits.clearance_m = kClearanceM;
  limits.thrust_share = 1.1;
  limits.speed_max_mps = 10.0;
  feasibility::Tolerances tolerances;
  tolerances.heading_force_share = 0.01;
  return feasibility::verify(stop, field, vessel::Parameters{}, limits, tolerances);
}

void expectRest(const Trajectory& stop) {
  const vessel::FlatPoint end = stop.flat(stop.duration());
  EXPECT_LT(end.velocity.norm(), 1e-6);
}

void expectContinues(const Trajectory& sailed, double at_s, const Trajectory& stop) {
  const vessel::FlatPoint before = sailed.flat(at_s);
  const vessel::FlatPoint after = stop.flat(0.0);
  EXPECT_LT((before.position - after.position).norm(), 1e-9);
  EXPECT_LT((before.velocity - after.velocity).norm(), 1e-9);
  EXPECT_LT((before.acceleration - after.acceleration).norm(), 1e-9);
  EXPECT_LT((before.jerk - after.jerk).norm(), 1e-8);
}

TEST(Braking, IsQuickButNotHardWhereThereIsRoom) {
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, kSpeed);
  const map::DistanceField field = fieldOf(openWater());
  const Braking stop = brakingTrajectory(sailed, 6.0, field, vessel::Parameters{}, {kClearanceM});
  ASSERT_TRUE(stop.clear);
  EXPECT_GT(stop.trajectory.duration(), 5.0);
  EXPECT_LT(stop.trajectory.duration(), 6.0);
  expectRest(stop.trajectory);
  expectContinues(sailed, 6.0, stop.trajectory);
}

// At 6 s the vessel is 2.8 m from where the disc crosses: at 6.65 s it would be there.
TEST(Braking, MeetsWhatMovesOnTheSailedTrajectorysClock) {
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, kSpeed);
  const map::DistanceField field = fieldOf(openWater());
  const Eigen::Vector2d northward(0.0, 4.0);
  for (const double crosses_s : {6.65, 0.65}) {
    const feasibility::test::MovingDisc disc(Eigen::Vector2d(-20.0, 0.0) - crosses_s * northward,
                                             northward, 1.0);
    feasibility::Obstacles obstacles(field);
    obstacles.add(disc);
    const Braking stop =
        brakingTrajectory(sailed, 6.0, obstacles, vessel::Parameters{}, {kClearanceM});
    EXPECT_EQ(stop.clear, crosses_s < 6.0);
  }
}

TEST(Braking, IsHardInFrontOfAWall) {
  map::OccupancyGrid grid = openWater();
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, kSpeed);
  const Eigen::Vector2d here = sailed.flat(6.0).position;
  block(grid, {here.x() + 9.7, -10.0}, {here.x() + 11.0, 10.0});
  const map::DistanceField field = fieldOf(grid);
  const Braking stop = brakingTrajectory(sailed, 6.0, field, vessel::Parameters{}, {kClearanceM});
  ASSERT_TRUE(stop.clear);
  EXPECT_LT(stop.trajectory.duration(), 4.0);
  EXPECT_LT(stop.trajectory.flat(100.0).position.x(), here.x() + 9.7 - 0.8);
  expectRest(stop.trajectory);
  EXPECT_TRUE(verify(stop.trajectory, field).ok);
}

// The usual stop would end clear, with a hand's breadth ahead of the bow, where waves would swing
// the hull against the wall; a harder one leaves room for that. Where none does, the one that
// leaves most is taken.
TEST(Braking, LeavesRoomToSwingAtRest) {
  map::OccupancyGrid grid = openWater();
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, kSpeed);
  const vessel::Parameters vessel;
  const double bow = 0.5 * vessel.hull.length_m;
  const Eigen::Vector2d here = sailed.flat(6.0).position;
  const Braking usual = brakingTrajectory(sailed, 6.0, fieldOf(grid), vessel, {kClearanceM, 0.02});
  const double way = usual.trajectory.flat(100.0).position.x() - here.x();
  block(grid, {here.x() + way + bow + 0.3, -10.0}, {here.x() + way + 4.0, 10.0});
  const map::DistanceField field = fieldOf(grid);
  StopLimits limits = {kClearanceM, 0.02};
  const auto room = [&] {
    const Braking stop = brakingTrajectory(sailed, 6.0, field, vessel, limits);
    EXPECT_TRUE(stop.clear);
    expectRest(stop.trajectory);
    return field.clearance(stop.trajectory.flat(100.0).position) - bow;
  };
  const double least = room();
  limits.rest_room_m = least + 0.3;
  EXPECT_GE(room(), least + 0.29);
  limits.rest_room_m = 100.0;
  EXPECT_GT(room(), least + 0.3);
}

// A load from abeam, which only turning to and fro with way on holds, swings it by 0.3 m; one from
// ahead doesn't, and less of it by less.
TEST(Braking, LeavesRoomToSwingWhereALoadSetsItAside) {
  map::OccupancyGrid grid = openWater();
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, kSpeed);
  vessel::Parameters vessel;
  vessel.manoeuvring = vessel::ManoeuvringModel::fromPaper(vessel.paper);
  const double bow = 0.5 * vessel.hull.length_m;
  const Eigen::Vector2d here = sailed.flat(6.0).position;
  const Braking usual = brakingTrajectory(sailed, 6.0, fieldOf(grid), vessel, {kClearanceM, 0.02});
  const double way = usual.trajectory.flat(100.0).position.x() - here.x();
  block(grid, {here.x() + way + bow + 0.25, -10.0}, {here.x() + way + 4.0, 10.0});
  const map::DistanceField field = fieldOf(grid);
  const auto room = [&](const Eigen::Vector2d& current_mps) {
    StopLimits limits = {kClearanceM, 0.02};
    limits.rest_load.current_mps = current_mps;
    const Braking stop = brakingTrajectory(sailed, 6.0, field, vessel, limits);
    EXPECT_TRUE(stop.clear);
    return field.clearance(stop.trajectory.flat(100.0).position) - bow;
  };
  const double least = room({0.0, 0.0});
  EXPECT_LT(least, 0.29);
  EXPECT_EQ(room({-0.25, 0.0}), least);
  EXPECT_EQ(room({0.0, 0.02}), least);
  EXPECT_GE(room({0.0, 0.25}), 0.29);
  EXPECT_GE(room({0.0, -0.25}), 0.29);
}

// Between walls that the planned hull keeps clear of, and leaning into a wind from abeam doesn't.
TEST(Braking, KeepsTheLeaningHullClear) {
  map::OccupancyGrid grid = openWater();
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, 1.5);
  const Eigen::Vector2d here = sailed.flat(10.0).position;
  for (const double side : {-1.0, 1.0}) {
    const double y = here.y() + 1.3 * side;
    block(grid, {here.x() + 1.2, y - 0.5}, {here.x() + 12.0, y + 0.5});
  }
  const map::DistanceField field = fieldOf(grid);
  vessel::Parameters vessel;
  vessel.manoeuvring = vessel::ManoeuvringModel::fromPaper(vessel.paper);
  vessel.manoeuvring.wind_surge_kgpm = 0.5;
  vessel.manoeuvring.wind_sway_kgpm = 0.5;
  StopLimits limits = {0.6, 0.02};
  EXPECT_TRUE(brakingTrajectory(sailed, 10.0, field, vessel, limits).clear);
  limits.felt.wind_mps = {0.0, 3.0};
  EXPECT_FALSE(brakingTrajectory(sailed, 10.0, field, vessel, limits).clear);
}

// The usual stop would end 11.8 m on, after 5.5 s; a disc comes over that place at 8 s.
TEST(Braking, EndsWhereNothingComesOverIt) {
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, kSpeed);
  const map::DistanceField field = fieldOf(openWater());
  const Eigen::Vector2d place = sailed.flat(6.0).position + Eigen::Vector2d(11.8, 0.0);
  const Eigen::Vector2d northward(0.0, 2.0);
  const feasibility::test::MovingDisc disc(place - 14.0 * northward, northward, 1.0);
  feasibility::Obstacles obstacles(field);
  obstacles.add(disc);
  const vessel::Parameters vessel;
  const Braking stop = brakingTrajectory(sailed, 6.0, obstacles, vessel, {kClearanceM});
  ASSERT_TRUE(stop.clear);
  EXPECT_TRUE(
      std::isinf(firstTouch(stop.trajectory, 0.0, obstacles.startingAt(6.0), vessel).after_s));
}

// A disc too large to pass comes up from ahead: contact can't be helped, but the way be off.
TEST(Braking, IsAtRestWhenItIsRunInto) {
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, kSpeed);
  const map::DistanceField field = fieldOf(openWater());
  const Eigen::Vector2d here = sailed.flat(6.0).position;
  const Eigen::Vector2d westward(-2.0, 0.0);
  const Eigen::Vector2d from = here + Eigen::Vector2d(36.5, 0.0) - 6.0 * westward;
  const feasibility::test::MovingDisc disc(from, westward, 20.0);
  feasibility::Obstacles obstacles(field);
  obstacles.add(disc);
  const vessel::Parameters vessel;
  const Braking stop = brakingTrajectory(sailed, 6.0, obstacles, vessel, {kClearanceM});
  const Touch touch = firstTouch(stop.trajectory, 0.0, obstacles.startingAt(6.0), vessel);
  EXPECT_TRUE(std::isfinite(touch.after_s));
  EXPECT_EQ(touch.speed_mps, 0.0);
  const Touch usual = firstTouch(sailed, 6.0, obstacles, vessel);
  EXPECT_GT(usual.speed_mps, 4.0);
  EXPECT_TRUE(touch.milderThan(usual));
  EXPECT_FALSE(usual.milderThan(touch));
}

TEST(Braking, StraightensOutOfACurve) {
  const Trajectory sailed = circle(15.0, 3.3, 20.0);
  map::OccupancyGrid grid = openWater();
  const Eigen::Vector2d ahead = sailed.flat(8.5).position;
  block(grid, ahead.array() - 1.0, ahead.array() + 1.0);
  const map::DistanceField field = fieldOf(grid);
  const Braking stop = brakingTrajectory(sailed, 5.0, field, vessel::Parameters{}, {kClearanceM});
  ASSERT_TRUE(stop.clear);
  expectRest(stop.trajectory);
  expectContinues(sailed, 5.0, stop.trajectory);
  const auto verified = verify(stop.trajectory, field);
  EXPECT_TRUE(verified.ok) << verified.reason;
}

// A disc comes over a hull at rest.
TEST(OutlineConflict, SeesWhatMerelyTouchesTheHull) {
  const Trajectory stop({trajectory::spinPiece({0.0, 0.0}, 0.0, 0.0, 20.0)});
  const map::DistanceField field = fieldOf(openWater());
  const feasibility::test::MovingDisc disc({12.0, 0.0}, {-1.0, 0.0}, 2.0);
  feasibility::Obstacles obstacles(field);
  obstacles.add(disc);
  const vessel::Parameters vessel;
  const Conflict touch = outlineConflict(stop, 0.0, 20.0, obstacles, vessel, 0.0);
  ASSERT_TRUE(touch.found);
  EXPECT_NEAR(touch.time_s, 10.0 - 0.5 * vessel.hull.length_m, 0.01);
  EXPECT_FALSE(outlineConflict(stop, 0.0, touch.time_s - 0.1, obstacles, vessel, 0.0).found);
}

TEST(Braking, DoesWhatItCanWhenNothingIsClear) {
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, kSpeed);
  map::OccupancyGrid grid = openWater();
  const Eigen::Vector2d here = sailed.flat(6.0).position;
  block(grid, {here.x() + 2.5, -10.0}, {here.x() + 40.0, 10.0});
  const Braking stop =
      brakingTrajectory(sailed, 6.0, fieldOf(grid), vessel::Parameters{}, {kClearanceM});
  EXPECT_FALSE(stop.clear);
  ASSERT_FALSE(stop.trajectory.empty());
  // The hardest stop goes least far.
  EXPECT_LT(stop.trajectory.flat(100.0).position.x(), here.x() + 5.0);
}

TEST(Braking, EndsASpinInPlaceWithoutAJump) {
  std::vector<trajectory::Piece> pieces = {trajectory::spinPiece({0.0, 0.0}, 0.0, 2.0, 4.0)};
  const Trajectory way = eastward({0.0, 0.0}, 40.0, kSpeed);
  pieces.insert(pieces.end(), way.pieces().begin(), way.pieces().end());
  const Trajectory sailed(std::move(pieces));
  const Braking stop =
      brakingTrajectory(sailed, 1.0, fieldOf(openWater()), vessel::Parameters{}, {kClearanceM});
  ASSERT_TRUE(stop.clear);
  EXPECT_LE(stop.trajectory.duration(), 1.0);
  const trajectory::Sample a = stop.trajectory.sample(0.0, vessel::Parameters{});
  const trajectory::Sample b = sailed.sample(1.0, vessel::Parameters{});
  EXPECT_TRUE(a.state.isApprox(b.state, 1e-6));
  const vessel::State end = stop.trajectory.sample(1.0, vessel::Parameters{}).state;
  EXPECT_LT(end.head<2>().norm() + end.tail<3>().norm(), 1e-6);
}

// On a leg astern the way says nothing of the heading: it is kept while the way comes off.
TEST(Braking, KeepsTheHeadingOnALegAstern) {
  const Trajectory leg({trajectory::straightLeg({0.0, 0.0}, 0.3, -8.0, 12.0)});
  const map::DistanceField field = fieldOf(openWater());
  for (const double at_s : {4.0, 6.0, 7.0}) {
    const Braking stop = brakingTrajectory(leg, at_s, field, vessel::Parameters{}, {kClearanceM});
    ASSERT_TRUE(stop.clear) << at_s;
    expectRest(stop.trajectory);
    expectContinues(leg, at_s, stop.trajectory);
    for (double t = 0.0; t < stop.trajectory.duration(); t += 0.1) {
      const vessel::State there = stop.trajectory.sample(t, vessel::Parameters{}).state;
      EXPECT_NEAR(there[vessel::kPsi], 0.3, 1e-6);
      EXPECT_NEAR(cross(unitVector(0.3), there.head<2>()), 0.0, 1e-6);
    }
    EXPECT_LT(stop.trajectory.flat(stop.trajectory.duration()).position.norm(), 8.0);
  }
}

// Nothing is clear, and the hull is set across its heading, so that no stop can be followed well:
// one that begins bow astern is worse than any.
TEST(Braking, GoesOnAsternWhereNothingIsClear) {
  const vessel::Parameters vessel;
  for (const double wall_m : {1.5, 2.0, 2.5, 3.0}) {
    vessel::FlatPoint from;
    from.velocity = {-0.75, 0.1};
    from.acceleration = {-0.4, 0.0};
    vessel::FlatPoint to;
    to.position = {-11.0, -3.0};
    to.velocity = {-1.5, -1.0};
    trajectory::Piece astern = trajectory::hermitePiece(from, to, 8.0);
    astern.kind = trajectory::PieceKind::kSpin;
    map::OccupancyGrid grid = openWater();
    block(grid, {-wall_m - 2.0, -10.0}, {-wall_m, 10.0});
    const map::DistanceField field = fieldOf(grid);
    const Braking stop = brakingTrajectory(Trajectory({astern}), 0.0, feasibility::Obstacles(field),
                                           vessel, StopLimits{0.5, 0.02});
    EXPECT_FALSE(stop.clear) << wall_m;
    ASSERT_FALSE(stop.trajectory.empty());
    EXPECT_NEAR(wrapAngle(stop.trajectory.sample(0.0, vessel).state[vessel::kPsi]), 0.0, 0.1)
        << wall_m;
  }
}

// A stop that is clear as planned may touch on the hull's way back to it.
TEST(Braking, IsJudgedAsTheHullLies) {
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, kSpeed);
  map::OccupancyGrid grid = openWater();
  const double ahead = sailed.flat(6.0).position.x() + 4.0;
  block(grid, {ahead, 0.8}, {ahead + 40.0, 3.0});
  const map::DistanceField field = fieldOf(grid);
  const vessel::Parameters vessel;
  const Off towards{{0.0, 0.4}, 0.0};
  const Off away{{0.0, -0.4}, 0.0};
  const Off turned{{0.0, 0.0}, 0.5};
  const auto clear = [&](const Off& off) {
    StopLimits limits{0.6, 0.02};
    limits.off = off;
    return brakingTrajectory(sailed, 6.0, field, vessel, limits).clear;
  };
  EXPECT_TRUE(clear({}));
  EXPECT_TRUE(clear(away));
  EXPECT_FALSE(clear(towards));
  EXPECT_FALSE(clear(turned));

  const auto touch = [&](const Off& off, double at_s) {
    return firstTouch(sailed, at_s, field, vessel, off).after_s;
  };
  EXPECT_TRUE(std::isinf(touch({}, 6.0)));
  EXPECT_TRUE(std::isinf(touch(away, 6.0)));
  EXPECT_LT(touch(towards, 6.0), 1.0);
  EXPECT_LT(touch(turned, 6.0), 1.0);
  // Made good by then.
  EXPECT_TRUE(std::isinf(touch(towards, 2.0)));
  // Where it touches already, the way on is judged by itself.
  EXPECT_TRUE(std::isinf(touch(towards, 8.0)));
}

// Where the path comes to a point, and the flat heading swings round in no time.
TEST(Braking, HoldsWhatHardlyMovesWithoutAWhirl) {
  const auto at = [](double x, double y, double vx, double vy) {
    vessel::FlatPoint point;
    point.position = {x, y};
    point.velocity = {vx, vy};
    return point;
  };
  const Trajectory sailed(
      {trajectory::hermitePiece(at(0.0, 0.0, 0.3, 0.0), at(0.1, 0.001, -0.3, 1e-4), 2.0)});
  const vessel::Parameters vessel;
  const double fastest = feasibility::SafetyLimits::of(vessel).yaw_rate_max_radps;
  double whirls_radps = 0.0;
  const map::DistanceField field = fieldOf(openWater());
  for (double t = 0.0; t < 2.0; t += 0.001) {
    whirls_radps =
        std::max(whirls_radps, std::abs(sailed.sample(t, vessel).state[vessel::kYawRate]));
    const Braking stop = brakingTrajectory(sailed, t, field, vessel, {kClearanceM});
    ASSERT_FALSE(stop.trajectory.empty());
    if (stop.trajectory.pieces().size() == 1) {
      for (double s = 0.0; s <= stop.trajectory.duration(); s += 0.05) {
        EXPECT_LT(std::abs(stop.trajectory.sample(s, vessel).state[vessel::kYawRate]),
                  2.0 * fastest);
      }
    }
  }
  EXPECT_GT(whirls_radps, 10.0 * fastest);
}

// At the end of a stop hardly any force is left: what the path makes of its heading then isn't the
// hull's, and holding it there doesn't turn it.
TEST(Braking, HoldsTheHeadingWhereHardlyAnyForceTellsIt) {
  vessel::FlatPoint slow;
  slow.velocity = {0.08, 0.0};
  slow.acceleration = {-0.1, 0.0};
  vessel::FlatPoint rest;
  rest.position = {0.05, 0.004};
  const Trajectory sailed({trajectory::hermitePiece(slow, rest, 1.2)});
  const vessel::Parameters vessel;
  const map::DistanceField field = fieldOf(openWater());
  double turns_rad = 0.0;
  double whirls_radps = 0.0;
  for (double t = 0.0; t < 1.2; t += 0.01) {
    whirls_radps =
        std::max(whirls_radps, std::abs(sailed.sample(t, vessel).state[vessel::kYawRate]));
    const Braking stop = brakingTrajectory(sailed, t, field, vessel, {kClearanceM});
    const auto psi = [&](double s) {
      return stop.trajectory.sample(s, vessel).state[vessel::kPsi];
    };
    turns_rad =
        std::max(turns_rad, std::abs(wrapAngle(psi(stop.trajectory.duration()) - psi(0.0))));
  }
  EXPECT_GT(whirls_radps, 1.0);
  EXPECT_LT(turns_rad, 0.3);
}

// From a standing start the way to a near goal takes less time than the gentlest stop; it is no
// stop for all that.
TEST(Braking, IsNeverTheRestOfTheVoyage) {
  const Trajectory sailed({trajectory::hermitePiece(
      {},
      [] {
        vessel::FlatPoint end;
        end.position = {14.0, 0.0};
        return end;
      }(),
      9.0)});
  for (const double at : {0.2, 1.0, 2.0}) {
    const Braking stop =
        brakingTrajectory(sailed, at, fieldOf(openWater()), vessel::Parameters{}, {kClearanceM});
    ASSERT_TRUE(stop.clear);
    const double fast = sailed.flat(at).velocity.norm();
    const double way = (stop.trajectory.flat(100.0).position - sailed.flat(at).position).norm();
    EXPECT_LT(way, 2.0 + 3.0 * fast) << at;
    for (double t = 0.0; t < stop.trajectory.duration(); t += 0.05) {
      EXPECT_LT(stop.trajectory.flat(t).velocity.norm(), fast + 0.5) << at;
    }
  }
}

// The margin is kept by the hull, not only by its centre.
TEST(Braking, KeepsTheMarginWithTheWholeHull) {
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, kSpeed);
  map::OccupancyGrid grid = openWater();
  const Eigen::Vector2d here = sailed.flat(6.0).position;
  block(grid, {here.x() - 5.0, 0.75}, {here.x() + 40.0, 3.0});
  const map::DistanceField field = fieldOf(grid);
  EXPECT_TRUE(brakingTrajectory(sailed, 6.0, field, vessel::Parameters{}, {0.6, 0.05}).clear);
  EXPECT_FALSE(brakingTrajectory(sailed, 6.0, field, vessel::Parameters{}, {0.6, 0.2}).clear);
}

TEST(FirstConflict, FindsAThinPostAndOnlyAhead) {
  map::OccupancyGrid grid = openWater();
  block(grid, {10.0, 1.0}, {10.2, 1.2});
  const map::DistanceField field = fieldOf(grid);
  const Trajectory sailed = eastward({-40.0, 0.0}, 80.0, kSpeed);
  const Conflict conflict = firstConflict(sailed, 0.0, field, 1.2);
  ASSERT_TRUE(conflict.found);
  EXPECT_NEAR(conflict.position.x(), 10.0, 0.9);
  EXPECT_LT(conflict.clearance_m, 1.2);
  EXPECT_FALSE(firstConflict(sailed, 0.0, field, 0.8).found);
  EXPECT_FALSE(firstConflict(sailed, conflict.time_s + 1.0, field, 1.2).found);
}

TEST(Remainder, IsTheSameWay) {
  const Trajectory sailed = circle(12.0, 3.0, 6.0);
  const Trajectory rest = remainder(sailed, 2.4);
  EXPECT_NEAR(rest.duration(), sailed.duration() - 2.4, 1e-12);
  for (const double t : {0.0, 0.3, 0.6, 1.9, 3.6}) {
    EXPECT_LT((rest.flat(t).position - sailed.flat(2.4 + t).position).norm(), 1e-9) << t;
    EXPECT_LT((rest.flat(t).jerk - sailed.flat(2.4 + t).jerk).norm(), 1e-7) << t;
  }
}

TEST(Splice, KeepsTheSailedWayUpToTheJoint) {
  const Trajectory sailed = circle(12.0, 3.0, 6.0);
  const Trajectory next = remainder(sailed, 3.5);
  const trajectory::TimedTrajectory spliced = splice({sailed, 0.0}, 2.4, {next, 3.5});
  EXPECT_NEAR(spliced.start_time_s, 2.0, 1e-12);
  EXPECT_NEAR(spliced.trajectory.duration(), 4.0, 1e-9);
  for (double t = 2.4; t < 6.0; t += 0.1) {
    const Eigen::Vector2d there = spliced.trajectory.flat(spliced.elapsed(t)).position;
    EXPECT_LT((there - sailed.flat(t).position).norm(), 1e-9) << t;
  }
}

// Beside the hull there is room for the centre all along, but not for the stern as it turns.
TEST(OutlineConflict, SeesTheHullInItsPlannedAttitude) {
  map::OccupancyGrid grid = openWater();
  block(grid, {-3.0, 0.8}, {3.0, 0.95});
  const map::DistanceField field = fieldOf(grid);
  const Trajectory turn({trajectory::spinPiece({0.0, 0.0}, 0.0, 1.0, 4.0)});
  EXPECT_FALSE(firstConflict(turn, 0.0, field, 0.65).found);
  const Conflict hull = outlineConflict(turn, 0.0, 4.0, field, vessel::Parameters{}, 0.03);
  ASSERT_TRUE(hull.found);
  EXPECT_GT(hull.time_s, 0.5);
  EXPECT_LT(hull.clearance_m, 0.05);
  EXPECT_FALSE(outlineConflict(turn, 0.0, 0.5, field, vessel::Parameters{}, 0.03).found);
}

// The end of a plan brakes with what plans may take; harder stops than that are not planned.
TEST(Braking, TakesTheWaysOwnRestAsHardAsThePlanBrakes) {
  const vessel::Parameters vessel;
  const auto astern = [&](const Trajectory& path) {
    double least = 0.0;
    for (double t = 0.0; t < path.duration(); t += 0.05) {
      least = std::min(least, path.sample(t, vessel).thrusts.minCoeff());
    }
    return -least / vessel.thrusters.astern_max_n;
  };
  vessel::FlatPoint from;
  from.velocity.x() = 2.0;
  Trajectory sailed;
  for (double duration = 6.0; duration > 1.0; duration -= 0.02) {
    vessel::FlatPoint to;
    to.position.x() = 0.5 * from.velocity.x() * duration;
    sailed = Trajectory({trajectory::hermitePiece(from, to, duration)});
    if (astern(sailed) > 0.92) {
      break;
    }
  }
  ASSERT_LT(astern(sailed), 0.99);
  const double end = sailed.flat(sailed.duration()).position.x();
  map::OccupancyGrid water = openWater();
  block(water, {end + 1.6, -20.0}, {end + 3.0, 20.0});
  const map::DistanceField field = fieldOf(water);
  const Braking stop = brakingTrajectory(sailed, 0.0, field, vessel, {kClearanceM});
  EXPECT_TRUE(stop.clear);
  EXPECT_NEAR(stop.trajectory.flat(stop.trajectory.duration()).position.x(), end, 0.05);
}

// Pushed to the east it drifts there, lying across: slowed down along that way it would need a
// force abeam, and ahead in a line another heading.
TEST(Braking, BringsAHullToRestThatItsLoadCarries) {
  constexpr double kDriftMps = 0.5;
  constexpr double kAtS = 1.0;
  constexpr double kAcrossRad = 2.0;  // where the bow is
  const auto otter =
      vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
  ASSERT_TRUE(otter);
  vessel::FlatPoint from;
  vessel::FlatPoint to;
  from.velocity = to.velocity = {kDriftMps, 0.0};
  to.position = {10.0 * kDriftMps, 0.0};
  trajectory::Piece drifting = trajectory::hermitePiece(from, to, 10.0);
  drifting.kind = trajectory::PieceKind::kSpin;
  drifting.heading[0] = kAcrossRad;
  const Trajectory sailed({drifting});
  StopLimits limits;
  limits.clearance_m = kClearanceM;
  map::OccupancyGrid wall = openWater();
  block(wall, {1.9, -10.0}, {3.0, 10.0});
  const auto stopIn = [&](const map::OccupancyGrid& water) {
    return brakingTrajectory(sailed, kAtS, fieldOf(water), *otter, limits);
  };
  EXPECT_FALSE(stopIn(openWater()).clear);
  limits.disturbance.force_n = {40.0, 0.0};
  const Braking stop = stopIn(openWater());
  ASSERT_TRUE(stop.clear);
  expectRest(stop.trajectory);
  const vessel::State end = stop.trajectory.sample(stop.trajectory.duration(), *otter).state;
  EXPECT_NEAR(std::abs(wrapAngle(end[vessel::kPsi])), kPi, 0.4);  // bow to it
  EXPECT_GT(end.x(), 1.0);
  EXPECT_LT(end.x(), 2.5);
  EXPECT_FALSE(stopIn(wall).clear);
}

}  // namespace
}  // namespace otter_nav::stopping
