// Room that is preferred is kept where the water is wide, and given up where it isn't.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "otter_nav/planner/planner.hpp"
#include "planner_ground.hpp"

namespace otter_nav::planner {
namespace {

constexpr double kPreferredM = 3.5;

struct Passage {
  bool found = false;
  double duration_s = 0.0;
  double least_m = std::numeric_limits<double>::infinity();  // of the hull's centre, half-way
};

vessel::Parameters otterGazebo() {
  return *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) +
                                 "/config/vessels/otter_gazebo.yaml");
}

// From 25 m west of the origin to 25 m east of it.
Passage passageOf(const map::DistanceField& field, const feasibility::SafetyLimits& limits) {
  const vessel::Parameters vessel = otterGazebo();
  const feasibility::Obstacles obstacles(field);
  Query query;
  query.limits = limits;
  query.limits.speed_max_mps = 1.0;
  query.start.flat.position = {-25.0, 0.0};
  query.goal.flat.position = {25.0, 0.0};
  Planner planner(Options{}, vessel);
  const Plan plan = planner.plan(obstacles, query, Termination{});
  Passage passage;
  passage.found = plan.outcome == Outcome::kSolved;
  passage.duration_s = plan.trajectory.duration();
  for (double t = 0.0; t < passage.duration_s; t += 0.1) {
    const Eigen::Vector2d p = plan.trajectory.flat(t).position;
    if (std::abs(p.x()) < 8.0) {
      passage.least_m = std::min(passage.least_m, obstacles.clearance(p, t));
    }
  }
  return passage;
}

Passage passageOf(const map::DistanceField& field, double preferred_m) {
  feasibility::SafetyLimits limits = feasibility::SafetyLimits::of(otterGazebo());
  limits.preferred_clearance_m = preferred_m;
  return passageOf(field, limits);
}

// Of a plan that must leave the hull no more than 5 cm.
Passage tightPassageOf(const map::DistanceField& field) {
  feasibility::SafetyLimits limits = feasibility::SafetyLimits::of(otterGazebo(), 0.6);
  limits.hull_margin_m = 0.05;
  return passageOf(field, limits);
}

TEST(PreferredRoom, IsKeptInWideWater) {
  for (const double side : {1.0, -1.0}) {
    const map::DistanceField field = test::withObstacle(-1.0, side > 0.0 ? 1.9 : -3.9, 2.0, 2.0);
    const Passage usual = passageOf(field, 0.0);
    const Passage wide = passageOf(field, kPreferredM);
    ASSERT_TRUE(usual.found && wide.found);
    EXPECT_LT(usual.least_m, 2.5);
    EXPECT_GT(wide.least_m, 0.9 * kPreferredM);
    EXPECT_LT(wide.duration_s, 1.05 * usual.duration_s);
  }
}

TEST(PreferredRoom, IsGivenUpInANarrowPassage) {
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, -1.0, 2.1, 2.0, 37.9);
  test::fill(grid, -1.0, -40.0, 2.0, 37.9);
  const Passage passage =
      passageOf(map::DistanceField(grid, map::DistanceFieldOptions{}), kPreferredM);
  ASSERT_TRUE(passage.found);
  EXPECT_GT(passage.least_m, 1.5);
}

// Little is asked for beside the hull, since somewhere there is no more: not all along the way.
TEST(PreferredRoom, IsKeptBesideTheHullThoughLittleIsAskedFor) {
  const double half_beam_m = 0.5 * otterGazebo().hull.beam_m;
  for (const double side : {1.0, -1.0}) {
    const map::DistanceField field = test::withObstacle(-1.0, side > 0.0 ? 0.4 : -2.4, 2.0, 2.0);
    const Passage passage = tightPassageOf(field);
    ASSERT_TRUE(passage.found);
    EXPECT_GT(passage.least_m, half_beam_m + 0.45) << side;
  }
}

TEST(PreferredRoom, BesideTheHullIsGivenUpInANarrowPassage) {
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, -1.0, 0.7, 2.0, 39.3);
  test::fill(grid, -1.0, -40.0, 2.0, 39.3);
  const Passage passage = tightPassageOf(map::DistanceField(grid, map::DistanceFieldOptions{}));
  ASSERT_TRUE(passage.found);
  EXPECT_GT(passage.least_m, 0.6);
}

}  // namespace
}  // namespace otter_nav::planner
