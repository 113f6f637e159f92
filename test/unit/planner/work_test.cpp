// A query under way ends soon, found or not: what it takes is counted and bounded, on every machine
// alike.
#include <gtest/gtest.h>

#include <string>

#include "../feasibility/moving_disc.hpp"
#include "../vessel_of.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/optimizer/global_optimizer.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "planner_ground.hpp"

namespace otter_nav::planner {
namespace {

// Eastward at full speed, towards a wall that the way leads round.
Query towardsAWall(const vessel::Parameters& vessel) {
  Query query;
  query.limits = feasibility::SafetyLimits::of(vessel);
  query.start.flat.position = {-20.0, 0.0};
  query.start.flat.velocity = {0.95 * query.limits.speed_max_mps, 0.0};
  query.goal.flat.position = {25.0, 0.0};
  return query;
}

class WorkTest : public ::testing::TestWithParam<const char*> {};

TEST_P(WorkTest, AQueryUnderWayThatFailsIsBounded) {
  constexpr int kMost = 6000;  // with what one step and one verification may be over
  const vessel::Parameters vessel = vessel::test::vesselOf(GetParam());
  Planner planner(Options{}, vessel);
  int failed = 0;
  for (const double ahead_m : {2.0, 2.5, 3.0, 3.5, 4.0, 5.0}) {
    const map::DistanceField field = test::withObstacle(-20.0 + ahead_m, -12.0, 2.0, 24.0);
    feasibility::Obstacles obstacles(field);
    Query query = towardsAWall(vessel);
    const Plan plan = planner.plan(obstacles, query, Termination{});
    failed += plan.outcome == Outcome::kSolved ? 0 : 1;
    EXPECT_LE(plan.figures.work, kMost) << ahead_m << " m ahead";
    // Among others, one that may end early, faster than its limit, has no more for all its tries.
    const feasibility::test::MovingDisc other({0.0, 30.0}, {1.0, 0.0}, 2.0);
    obstacles.add(other);
    query.may_end_early = true;
    query.limits.speed_max_mps *= 0.5;
    EXPECT_LE(planner.plan(obstacles, query, Termination{}).figures.work, kMost)
        << ahead_m << " m ahead, too fast";
  }
  EXPECT_GE(failed, 3);
}

// A way that turns back at full speed with a wall beside asks for many times the thrust there is.
TEST(WorkTest, WhatIsHopelessUnderWayIsGivenUp) {
  const vessel::Parameters vessel = vessel::test::vesselOf("otter_gazebo");
  const map::DistanceField field = test::withObstacle(-17.0, -12.0, 2.0, 24.0);
  const feasibility::Obstacles obstacles(field);
  const Query query = towardsAWall(vessel);
  optimizer::GlobalOptimizer optimizer(optimizer::GlobalOptions{}, vessel);
  optimizer::Budget budget;
  budget.max_attempts = 1;
  const std::vector<Eigen::Vector2d> round = {
      {-20.0, 0.0}, {-19.0, 13.0}, {-12.0, 14.0}, {25.0, 0.0}};
  EXPECT_FALSE(optimizer.optimize(obstacles, round, query.start, query.goal, budget, query.limits));
  EXPECT_LT(optimizer.work(), 800) << "three rounds, not five";
}

// The motion along a plan, which whoever asks for its verification may have already, is the one
// that is judged.
TEST(WorkTest, AVerificationTakesTheMotionItIsGiven) {
  const vessel::Parameters vessel = vessel::test::vesselOf("otter");
  const map::DistanceField field = test::openWater();
  const feasibility::Obstacles obstacles(field);
  Query query;
  query.limits = feasibility::SafetyLimits::of(vessel);
  query.start.flat.position = {-20.0, 0.0};
  query.goal.flat.position = {20.0, 5.0};
  const Plan plan = Planner(Options{}, vessel).plan(obstacles, query, Termination{});
  ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
  const auto judgedUnder = [&](const vessel::Disturbance& load) {
    const trajectory::MotionAlong motion(plan.trajectory, vessel, load, query.start.psi_rad);
    return feasibility::verify(plan.trajectory, obstacles, vessel, query.start, query.goal,
                               query.limits, {}, &motion);
  };
  const feasibility::Verification alone = feasibility::verify(
      plan.trajectory, obstacles, vessel, query.start, query.goal, query.limits);
  EXPECT_TRUE(alone.ok) << alone.reason;
  const feasibility::Verification given = judgedUnder(query.limits.disturbance);
  EXPECT_TRUE(given.ok) << given.reason;
  EXPECT_EQ(given.thrust_share, alone.thrust_share);
  EXPECT_EQ(given.clearance_m, alone.clearance_m);
  // One under a load that the limits don't know asks for more.
  vessel::Disturbance load;
  load.force_n = {-80.0, 0.0};
  EXPECT_FALSE(judgedUnder(load).ok);
}

INSTANTIATE_TEST_SUITE_P(Vessels, WorkTest, ::testing::Values("otter_gazebo", "otter"));

}  // namespace
}  // namespace otter_nav::planner
