// What the global optimiser returns is verified, nearly as short as its way, quick where the
// optimum is known, and the same each time.
#include "otter_nav/optimizer/global_optimizer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/random.hpp"

namespace otter_nav::optimizer {
namespace {

map::DistanceField islands(Random& random, int count) {
  map::OccupancyGrid grid;
  grid.geometry = {320, 320, 0.5, {-80.0, -80.0}};
  grid.cells.assign(102400, map::Cell::kFree);
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(60.0, 260.0);
    const double y = random.uniform(130.0, 190.0);
    for (int row = 0; row < 320; ++row) {
      for (int column = 0; column < 320; ++column) {
        if (std::hypot(column - x, row - y) < 4.0) {
          grid.cells[grid.geometry.index(column, row)] = map::Cell::kOccupied;
        }
      }
    }
  }
  return map::DistanceField(grid, {});
}

trajectory::Boundary berth(double x, double y, double psi_rad) {
  trajectory::Boundary b;
  b.flat.position = {x, y};
  b.psi_rad = psi_rad;
  return b;
}

TEST(GlobalOptimizer, StraightAheadTakesTheTimeFullThrustDoes) {
  const vessel::Parameters vessel;
  Random random(1);
  const map::DistanceField field = islands(random, 0);
  const GlobalOptions options;
  GlobalOptimizer optimizer(options, vessel);
  const auto result = optimizer.optimize(
      field, std::vector<Eigen::Vector2d>{{-30.0, 0.0}, {30.0, 0.0}}, berth(-30.0, 0.0, 0.0),
      berth(30.0, 0.0, 0.0), Budget(), feasibility::SafetyLimits::of(vessel));
  ASSERT_TRUE(result.has_value()) << result.error().message;
  EXPECT_NEAR(trajectory::length(result->trajectory), 60.0, 0.05);
  // Bang-bang under the share allowed: no trajectory is quicker.
  const double force = 100.0 * feasibility::SafetyLimits::of(vessel).thrust_share;
  double best = 0.0;
  double s = 0.0;
  double v = 0.0;
  const auto stop_in = [&](double speed) {
    double way = 0.0;
    for (; speed > 0.0; speed -= 1e-3 * (force + 20.0 * speed) / 35.0) {
      way += 1e-3 * speed;
      best += 1e-3;
    }
    return way;
  };
  for (;; best += 1e-3) {
    const double before = best;
    if (s + stop_in(v) >= 60.0) {
      break;
    }
    best = before;
    s += 1e-3 * v;
    v = std::min(v + 1e-3 * (force - 20.0 * v) / 35.0, 4.85);
  }
  EXPECT_GT(result->trajectory.duration(), best);
  EXPECT_LT(result->trajectory.duration(), 1.2 * best);
}

TEST(GlobalOptimizer, ReturnsVerifiedTrajectoriesAmongIslands) {
  const vessel::Parameters vessel;
  Random random(5);
  GlobalOptimizer optimizer(GlobalOptions(), vessel);
  int sailed = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const map::DistanceField field = islands(random, 6);
    const trajectory::Boundary start =
        berth(-55.0, random.uniform(-10.0, 10.0), random.uniform(-3.1, 3.1));
    const trajectory::Boundary goal =
        berth(55.0, random.uniform(-10.0, 10.0), random.uniform(-3.1, 3.1));
    // Around the islands, to the north or the south.
    const double side = trial % 2 == 0 ? 20.0 : -20.0;
    const std::vector<Eigen::Vector2d> way = {
        start.flat.position, {-45.0, side}, {45.0, side}, goal.flat.position};
    const auto result = optimizer.optimize(field, way, start, goal, Budget(),
                                           feasibility::SafetyLimits::of(vessel));
    ASSERT_TRUE(result.has_value()) << trial << ": " << result.error().message;
    const feasibility::Verification again = verify(result->trajectory, field, vessel, start, goal,
                                                   feasibility::SafetyLimits::of(vessel));
    EXPECT_TRUE(again.ok) << again.reason;
    EXPECT_LT(trajectory::length(result->trajectory), 1.05 * lengthOf(way));
    sailed += result->last_resort ? 0 : 1;
  }
  EXPECT_GE(sailed, 11);
}

TEST(GlobalOptimizer, FromAMovingStartTakesOverItsMotion) {
  const vessel::Parameters vessel;
  Random random(3);
  const map::DistanceField field = islands(random, 0);
  GlobalOptimizer optimizer(GlobalOptions(), vessel);
  trajectory::Boundary start = berth(-40.0, 0.0, 0.0);
  start.flat.velocity = {3.5, 0.5};
  start.flat.acceleration = {0.1, 0.1};
  start.flat.jerk = {0.0, 0.02};
  const auto result = optimizer.optimize(
      field, std::vector<Eigen::Vector2d>{{-40.0, 0.0}, {0.0, 8.0}, {40.0, 0.0}}, start,
      berth(40.0, 0.0, 0.2), Budget(), feasibility::SafetyLimits::of(vessel));
  ASSERT_TRUE(result.has_value()) << result.error().message;
  const vessel::FlatPoint z = result->trajectory.flat(0.0);
  EXPECT_LT((z.velocity - start.flat.velocity).norm(), 1e-9);
  EXPECT_LT((z.jerk - start.flat.jerk).norm(), 1e-9);
}

TEST(GlobalOptimizer, SameInputsGiveTheSameTrajectory) {
  const vessel::Parameters vessel;
  Random random(9);
  const map::DistanceField field = islands(random, 4);
  const std::vector<Eigen::Vector2d> way = {{-50.0, 0.0}, {0.0, 22.0}, {50.0, 0.0}};
  const auto run = [&] {
    GlobalOptimizer optimizer(GlobalOptions(), vessel);
    return optimizer.optimize(field, way, berth(-50.0, 0.0, 1.0), berth(50.0, 0.0, -1.0), Budget(),
                              feasibility::SafetyLimits::of(vessel));
  };
  const auto a = run();
  const auto b = run();
  ASSERT_TRUE(a.has_value() && b.has_value());
  ASSERT_EQ(a->trajectory.pieces().size(), b->trajectory.pieces().size());
  for (std::size_t i = 0; i < a->trajectory.pieces().size(); ++i) {
    EXPECT_EQ(a->trajectory.pieces()[i].position, b->trajectory.pieces()[i].position);
    EXPECT_EQ(a->trajectory.pieces()[i].duration_s, b->trajectory.pieces()[i].duration_s);
  }
}

// A wall with a channel on both sides, too narrow to turn in but at its end: whatever comes back
// has stopped there, and nowhere else.
TEST(GlobalOptimizer, StopsAtTheSharpestCornerAloneWhereNothingLeadsRoundIt) {
  map::OccupancyGrid grid;
  grid.geometry = {320, 160, 0.25, {-40.0, -20.0}};
  grid.cells.assign(320 * 160, map::Cell::kOccupied);
  const auto free = [&](double x0, double x1, double y0, double y1) {
    for (int row = 0; row < 160; ++row) {
      for (int column = 0; column < 320; ++column) {
        const Eigen::Vector2d p = grid.geometry.centreOf(column, row);
        if (p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1) {
          grid.cells[grid.geometry.index(column, row)] = map::Cell::kFree;
        }
      }
    }
  };
  free(-35.0, 22.0, 0.0, 3.0);
  free(19.0, 22.0, 0.0, 15.0);
  free(-35.0, 22.0, 12.0, 15.0);
  const map::DistanceField field(grid, {});
  const std::vector<Eigen::Vector2d> path = {
      {-30.0, 1.5}, {20.5, 1.5}, {20.5, 13.5}, {-30.0, 13.5}};
  const vessel::Parameters vessel;
  GlobalOptimizer optimizer(GlobalOptions(), vessel);
  const auto limits = feasibility::SafetyLimits::of(vessel);
  const trajectory::Boundary start = berth(-30.0, 1.5, 0.0);
  const trajectory::Boundary goal = berth(-30.0, 13.5, kPi);
  const auto stops = optimizer.stopAndSpin(field, path, start, goal, limits);
  ASSERT_TRUE(stops.has_value()) << stops.error().message;
  const auto result = optimizer.optimize(field, path, start, goal, Budget(), limits);
  ASSERT_TRUE(result.has_value()) << result.error().message;
  EXPECT_TRUE(result->verification.ok);
  EXPECT_LT(result->trajectory.duration(), 0.85 * stops->trajectory.duration())
      << "last resort: " << result->last_resort;
}

// Rooms in a row with a door in each wall: at the doors the vessel brakes into sharp turns.
TEST(GlobalOptimizer, TurnsSharplyThroughManyDoors) {
  constexpr int kWalls = 12;
  constexpr double kRoomM = 18.0;
  constexpr double kDoorM = 5.0;
  const vessel::Parameters vessel;
  GlobalOptimizer optimizer(GlobalOptions(), vessel);
  Random random(11);
  int sailed = 0;
  for (int trial = 0; trial < 40; ++trial) {
    map::OccupancyGrid grid;
    grid.geometry = {4 * static_cast<int>(kRoomM * (kWalls + 1)), 200, 0.25, {0.0, -25.0}};
    grid.cells.assign(static_cast<std::size_t>(grid.geometry.width) * 200, map::Cell::kFree);
    std::vector<Eigen::Vector2d> way = {{0.5 * kRoomM, 0.0}};
    for (int wall = 1; wall <= kWalls; ++wall) {
      const double y = random.uniform(14.0, 20.0) * (wall % 2 == 0 ? 1.0 : -1.0);
      for (int row = 0; row < 200; ++row) {
        const int column = static_cast<int>(4.0 * kRoomM * wall);
        if (std::abs(grid.geometry.centreOf(column, row).y() - y) > 0.5 * kDoorM) {
          for (int thick = 0; thick < 3; ++thick) {
            grid.cells[grid.geometry.index(column + thick, row)] = map::Cell::kOccupied;
          }
        }
      }
      // By the near side of the door, as guide paths go.
      const double near_y = y - std::copysign(0.5 * kDoorM - 1.2, y);
      way.emplace_back(kRoomM * wall - 1.0, near_y);
      way.emplace_back(kRoomM * wall + 1.8, near_y);
    }
    way.emplace_back(kRoomM * (kWalls + 0.5), 0.0);
    const map::DistanceField field(grid, {});
    const auto result = optimizer.optimize(field, way, berth(way.front().x(), 0.0, -1.0),
                                           berth(way.back().x(), 0.0, -1.0), Budget(),
                                           feasibility::SafetyLimits::of(vessel));
    ASSERT_TRUE(result.has_value()) << trial << ": " << result.error().message;
    EXPECT_TRUE(result->verification.ok);
    sailed += result->last_resort ? 0 : 1;
  }
  EXPECT_GE(sailed, 34);
}

}  // namespace
}  // namespace otter_nav::optimizer
