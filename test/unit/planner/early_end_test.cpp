// Plans that may end short of the goal, and queries that come with a guide path.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "../feasibility/moving_disc.hpp"
#include "../vessel_of.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/topology/guide_path.hpp"
#include "planner_ground.hpp"

namespace otter_nav::planner {
namespace {

using Eigen::Vector2d;

// 80 m to the north-east, with walls from both sides between.
map::DistanceField betweenWalls() {
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, -20.0, -40.0, 2.0, 50.0);
  test::fill(grid, 5.0, -10.0, 2.0, 50.0);
  return map::DistanceField(grid, map::DistanceFieldOptions{});
}

Query northEast(const vessel::Parameters& vessel) {
  Query query;
  query.limits = feasibility::SafetyLimits::of(vessel);
  query.start.flat.position = {-32.0, -25.0};
  query.goal.flat.position = {32.0, 25.0};
  query.may_end_early = true;
  return query;
}

std::vector<Vector2d> guideOf(const map::DistanceField& field, const Query& query) {
  topology::GuidePathFinder finder(topology::Options{});
  const vessel::Pose goal{query.goal.flat.position, query.goal.psi_rad};
  const auto guide = finder.find(field, query.guideStart(), goal, query.limits.clearance_m);
  EXPECT_TRUE(guide);
  return guide ? guide->points : std::vector<Vector2d>{};
}

double lengthOf(const std::vector<Vector2d>& line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    length += (line[i] - line[i - 1]).norm();
  }
  return length;
}

double nearest(const std::vector<Vector2d>& line, const Vector2d& place) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i) {
    for (double share = 0.0; share <= 1.0; share += 0.01) {
      least = std::min(least, (line[i - 1] + share * (line[i] - line[i - 1]) - place).norm());
    }
  }
  return least;
}

class EarlyEndTest : public ::testing::TestWithParam<const char*> {};

// A guide path leads to the goal, not to where a part of the way ends.
TEST_P(EarlyEndTest, APartOfTheWayIsFoundAlongAGivenGuidePathToo) {
  const vessel::Parameters vessel = vessel::test::vesselOf(GetParam());
  const map::DistanceField field = betweenWalls();
  Query query = northEast(vessel);
  feasibility::Obstacles obstacles(field);
  const feasibility::test::MovingDisc over_the_goal(query.goal.flat.position, {0.01, 0.0}, 6.0);
  obstacles.add(over_the_goal);
  Options options;
  options.keep_trees = true;
  Planner planner(options, vessel);
  const Plan own = planner.plan(obstacles, query, Termination{});
  ASSERT_EQ(own.outcome, Outcome::kSolved) << own.reason;
  ASSERT_GT(own.left_m, 0.0);
  query.guide_path = guideOf(field, query);
  const Plan given = planner.plan(obstacles, query, Termination{});
  ASSERT_EQ(given.outcome, Outcome::kSolved) << given.reason;
  EXPECT_GT(given.left_m, 0.0);
  EXPECT_EQ(given.figures.length_m, own.figures.length_m);
  EXPECT_EQ(given.figures.work, own.figures.work);
  EXPECT_NEAR(lengthOf(given.guide_path), given.figures.length_m, 3.0);
}

TEST_P(EarlyEndTest, WhatLedToNowhereCountsBesideAGivenGuidePath) {
  constexpr double kKeptM = 0.4;
  const vessel::Parameters vessel = vessel::test::vesselOf(GetParam());
  const map::DistanceField field = betweenWalls();
  Query query = northEast(vessel);
  query.guide_path = guideOf(field, query);
  ASSERT_GE(query.guide_path.size(), 3U);
  query.dead_ends = {query.guide_path[query.guide_path.size() / 2]};
  Options options;
  options.keep_trees = true;
  const Plan plan =
      Planner(options, vessel).plan(feasibility::Obstacles(field), query, Termination{});
  ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
  EXPECT_GT(nearest(plan.guide_path, query.dead_ends.front()), kKeptM);
}

// The farthest place in reach may be the last one of the guide path, just short of the goal.
TEST_P(EarlyEndTest, SomethingIsLeftUnlessThePlanLeadsToTheGoal) {
  const vessel::Parameters vessel = vessel::test::vesselOf(GetParam());
  const map::DistanceField field = test::openWater();
  Query query;
  query.limits = feasibility::SafetyLimits::of(vessel);
  query.may_end_early = true;
  query.may_creep = true;
  Termination no_trees;
  no_trees.max_iterations = 0;
  for (const double way_m : {22.75, 22.85, 23.5, 30.0}) {
    query.goal.flat.position = {way_m, 0.0};
    const Plan plan =
        Planner(Options{}, vessel).plan(feasibility::Obstacles(field), query, no_trees);
    ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
    const Vector2d end = plan.trajectory.flat(plan.trajectory.duration()).position;
    EXPECT_NEAR(plan.left_m, (query.goal.flat.position - end).norm(), 0.01) << way_m;
  }
}

TEST_P(EarlyEndTest, LimitsThatAllowNoMotionAreRefused) {
  const vessel::Parameters vessel = vessel::test::vesselOf(GetParam());
  const map::DistanceField field = test::openWater();
  Planner planner(Options{}, vessel);
  for (const double way_m : {0.2, 20.0}) {
    for (const bool early : {false, true}) {
      Query query;
      query.may_end_early = early;
      query.may_creep = early;
      query.goal.flat.position = {way_m, 0.0};
      query.limits = feasibility::SafetyLimits::of(vessel);
      query.limits.speed_max_mps = 0.0;
      const Plan slow = planner.plan(feasibility::Obstacles(field), query, Termination{});
      EXPECT_EQ(slow.outcome, Outcome::kNoPath);
      EXPECT_EQ(slow.reason, "the limits allow no speed");
      query.limits = feasibility::SafetyLimits::of(vessel);
      query.limits.thrust_share = 0.0;
      const Plan weak = planner.plan(feasibility::Obstacles(field), query, Termination{});
      EXPECT_EQ(weak.outcome, Outcome::kNoPath);
      EXPECT_EQ(weak.reason, "the limits allow no thrust");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Vessels, EarlyEndTest, ::testing::Values("otter_gazebo", "otter"));

}  // namespace
}  // namespace otter_nav::planner
