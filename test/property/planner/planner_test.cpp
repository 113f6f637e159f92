// What holds for every plan: soundness, sameness for a seed, honest outcomes.
#include "otter_nav/planner/planner.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "../../unit/planner/planner_ground.hpp"
#include "islands.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/feasibility/verifier.hpp"

namespace otter_nav::planner {
namespace {

Query across() {
  Query query;
  query.limits = feasibility::SafetyLimits::of(vessel::Parameters{});
  query.start.flat.position = {-30.0, -5.0};
  query.start.psi_rad = 1.0;
  query.goal.flat.position = {30.0, 5.0};
  query.goal.psi_rad = -2.0;
  return query;
}

feasibility::Verification verifyPlan(const Plan& plan, const map::DistanceField& field,
                                     const Query& query) {
  return feasibility::verify(plan.trajectory, field, vessel::Parameters{}, query.start, query.goal,
                             query.limits);
}

class EveryMethod : public ::testing::TestWithParam<std::pair<bool, bool>> {};

TEST_P(EveryMethod, ReturnsWhatPassesVerification) {
  const map::DistanceField field = test::islands();
  Options options;
  options.local_optimization = GetParam().first;
  options.global_optimization = GetParam().second;
  Planner planner(options, vessel::Parameters{});
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Query query = across();
    query.seed = seed;
    const Plan plan = planner.plan(field, query, test::byIterations());
    ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
    const auto verification = verifyPlan(plan, field, query);
    EXPECT_TRUE(verification.ok) << verification.reason;
    EXPECT_GT(plan.figures.node_utilization, 0.0);
    EXPECT_LE(plan.figures.node_utilization, 1.0);
    EXPECT_NEAR(plan.figures.length_m, trajectory::length(plan.trajectory), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Ablation, EveryMethod,
                         ::testing::Values(std::pair{false, false}, std::pair{true, false},
                                           std::pair{false, true}, std::pair{true, true}));

TEST(Planner, IsTheSameForASeed) {
  const map::DistanceField field = test::islands();
  Planner fresh(Options{}, vessel::Parameters{});
  Planner used(Options{}, vessel::Parameters{});
  Query other = across();
  other.goal.flat.position = {25.0, -25.0};
  (void)used.plan(field, other, test::byIterations());
  const Plan a = fresh.plan(field, across(), test::byIterations());
  const Plan b = used.plan(field, across(), test::byIterations());
  ASSERT_EQ(a.trajectory.pieces().size(), b.trajectory.pieces().size());
  EXPECT_EQ(a.trajectory.duration(), b.trajectory.duration());
  for (std::size_t i = 0; i < a.trajectory.pieces().size(); ++i) {
    EXPECT_EQ(a.trajectory.pieces()[i].position, b.trajectory.pieces()[i].position);
  }
}

TEST(Planner, SaysWhyThereIsNoPlan) {
  const map::DistanceField field = test::islands();
  Planner planner(Options{}, vessel::Parameters{});
  Query query = across();
  query.start.flat.position = {-9.0, 0.0};
  EXPECT_EQ(planner.plan(field, query, test::byIterations()).outcome, Outcome::kStartBlocked);
  query = across();
  query.goal.flat.position = {10.0, 5.0};
  EXPECT_EQ(planner.plan(field, query, test::byIterations()).outcome, Outcome::kGoalBlocked);
  query.goal.flat.position = {300.0, 5.0};
  const Plan outside = planner.plan(field, query, test::byIterations());
  EXPECT_EQ(outside.outcome, Outcome::kGoalBlocked);
  EXPECT_NE(outside.reason.find("outside the map"), std::string::npos) << outside.reason;
  query.goal.flat.position.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(planner.plan(field, query, test::byIterations()).outcome, Outcome::kGoalBlocked);
}

TEST(Planner, GoesNoFartherThanItMustToAGoalNearby) {
  const map::DistanceField field = test::islands();
  Planner planner(Options{}, vessel::Parameters{});
  for (const double distance : {0.0, 0.1, 0.29}) {
    for (const double turn : {0.0, -2.5}) {
      Query query = across();
      query.goal.flat.position = query.start.flat.position + Eigen::Vector2d(0.0, distance);
      query.goal.psi_rad = query.start.psi_rad + turn;
      const Plan plan = planner.plan(field, query, test::byIterations());
      ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
      EXPECT_TRUE(verifyPlan(plan, field, query).ok) << verifyPlan(plan, field, query).reason;
      EXPECT_NEAR(plan.figures.length_m, distance, 1e-6);
    }
  }
}

// Turning and thrust overlap at both ends: turned half round at both, 60 m take less than at 3 m/s.
TEST(Planner, WastesLittleTimeTurningAtTheEnds) {
  const map::DistanceField field(test::openGrid(), map::DistanceFieldOptions{});
  Planner planner(Options{}, vessel::Parameters{});
  for (const double psi : {0.0, 1.6, 3.1}) {
    Query query = across();
    query.start.psi_rad = psi;
    query.goal.psi_rad = -psi;
    const Plan plan = planner.plan(field, query, test::byIterations());
    ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
    EXPECT_GT(plan.figures.length_m / plan.figures.duration_s, 3.0) << psi;
    EXPECT_LT(plan.figures.length_m, 65.0) << psi;
  }
}

TEST(Planner, SaysThatThereIsNoWay) {
  const map::DistanceField wall = test::withObstacle(0.0, -40.0, 2.0, 80.0);
  Planner planner(Options{}, vessel::Parameters{});
  const Plan plan = planner.plan(wall, across(), test::byIterations());
  EXPECT_EQ(plan.outcome, Outcome::kNoPath);
  EXPECT_FALSE(plan.reason.empty());
  EXPECT_TRUE(plan.trajectory.empty());
}

// The goal lies across a channel narrower than the hull is long: there is no turning there.
TEST(Planner, EndsEarlyWhereItMayAndTheWholeWayCantBePlanned) {
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, 10.0, -40.0, 30.0, 39.0);
  test::fill(grid, 10.0, 1.0, 30.0, 39.0);
  const map::DistanceField field(grid, map::DistanceFieldOptions{});
  Query query;
  query.limits = feasibility::SafetyLimits::of(vessel::Parameters{});
  query.start.flat.position = {-20.0, 0.0};
  query.goal.flat.position = {30.0, 0.0};
  query.goal.psi_rad = 1.5707963;
  query.limits.clearance_m = 0.65;
  Planner planner(Options{}, vessel::Parameters{});
  EXPECT_NE(planner.plan(field, query, test::byIterations()).outcome, Outcome::kSolved);
  query.may_end_early = true;
  const Plan part = planner.plan(field, query, test::byIterations());
  ASSERT_EQ(part.outcome, Outcome::kSolved) << part.reason;
  EXPECT_GT(part.left_m, 15.0);
  EXPECT_LT(part.left_m, 45.0);
  Query ends = query;
  ends.goal.flat = part.trajectory.flat(part.trajectory.duration());
  EXPECT_LT(ends.goal.flat.velocity.norm(), 1e-3);
  EXPECT_GT(ends.goal.flat.position.x(), query.start.flat.position.x() + 5.0);
  // What can be planned is planned whole.
  query.goal.psi_rad = 0.0;
  const Plan whole = planner.plan(field, query, test::byIterations());
  ASSERT_EQ(whole.outcome, Outcome::kSolved) << whole.reason;
  EXPECT_EQ(whole.left_m, 0.0);
}

// A canal with a bend that the hull can't turn in while it sails, and just so on the spot.
map::DistanceField bentCanal() {
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, -0.75, -8.0, 40.0, 7.0);  // south of the arm to the east
  test::fill(grid, -40.0, -8.0, 39.25, 48.0);
  test::fill(grid, 1.5, 1.0, 40.0, 39.0);
  return map::DistanceField(grid, map::DistanceFieldOptions{});
}

TEST(Planner, CreepsWhereNothingElseLeadsOn) {
  const map::DistanceField field = bentCanal();
  Query query;
  query.limits = feasibility::SafetyLimits::of(vessel::Parameters{}, 0.64);
  query.limits.hull_margin_m = 0.05;
  query.start.flat.position = {0.4, 9.0};
  query.start.psi_rad = 1.5707963;  // bow the wrong way, and no room to turn
  query.goal.flat.position = {14.0, 0.0};
  query.goal.psi_rad = 3.1415926;
  query.may_end_early = true;
  Planner planner(Options{}, vessel::Parameters{});
  const Plan without = planner.plan(field, query, test::byIterations());
  query.may_creep = true;
  const Plan plan = planner.plan(field, query, test::byIterations());
  ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
  EXPECT_NE(without.outcome, Outcome::kSolved);
  EXPECT_EQ(plan.left_m, 0.0);
  const auto verification = feasibility::verify(plan.trajectory, field, vessel::Parameters{},
                                                query.start, query.goal, query.limits);
  EXPECT_TRUE(verification.ok) << verification.reason;
  // Under way there is always another.
  query.start.flat.velocity = {0.0, 0.5};
  EXPECT_NE(planner.plan(field, query, test::byIterations()).outcome, Outcome::kSolved);
}

// Waves have set it nearer to the wall than plans keep, and the goal is out of the search's reach.
TEST(Planner, CreepsFromNearerThanPlansKeep) {
  const map::DistanceField field = bentCanal();
  Query query;
  query.limits = feasibility::SafetyLimits::of(vessel::Parameters{}, 0.64);
  query.limits.hull_margin_m = 0.05;
  query.start.flat.position = {0.87, 9.0};
  query.start.psi_rad = 1.5707963;
  query.goal.flat.position = {30.0, 0.0};
  query.may_end_early = true;
  query.may_creep = true;
  ASSERT_LT(field.clearance(query.start.flat.position), query.limits.clearance_m);
  Planner planner(Options{}, vessel::Parameters{});
  const Plan plan = planner.plan(field, query, test::byIterations());
  ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
  EXPECT_GT(plan.left_m, 0.0);
  EXPECT_LT(plan.left_m, 25.0);
}

// The centre comes nearer to both posts of a gap than plans keep; the hull's own sides don't.
TEST(Planner, CreepsThroughAGapThatTheHullPasses) {
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, -40.0, 4.0, 39.5, 1.0);
  test::fill(grid, 0.75, 4.0, 39.25, 1.0);
  const map::DistanceField field(grid, map::DistanceFieldOptions{});
  Query query;
  query.limits = feasibility::SafetyLimits::of(vessel::Parameters{}, 0.64);
  query.limits.hull_margin_m = 0.0;
  query.start.flat.position = {0.125, 0.0};
  query.start.psi_rad = 1.5707963;
  query.goal.flat.position = {0.125, 10.0};
  query.goal.psi_rad = 1.5707963;
  query.may_creep = true;
  Planner planner(Options{}, vessel::Parameters{});
  EXPECT_NE(planner.plan(field, query, test::byIterations()).outcome, Outcome::kSolved);
  query.may_end_early = true;  // as at the narrowest clearance
  const Plan plan = planner.plan(field, query, test::byIterations());
  EXPECT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
  EXPECT_EQ(plan.left_m, 0.0);
}

// Among posts: from stop to stop along the guide path takes longer than creeping, now and then.
TEST(Planner, CreepsWhereThatIsQuickerThanFromStopToStop) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  Planner planner(Options{}, vessel::Parameters{});
  int quicker = 0;
  for (int k = 0; k < 4; ++k) {
    map::OccupancyGrid grid = test::openGrid();
    test::fill(grid, -40.0, -10.5, 34.0, 21.0);
    test::fill(grid, 6.0, -10.5, 34.0, 21.0);
    for (int n = 0; n < 75; ++n) {
      test::fill(grid, 0.6 * place(random), place(random), 0.3, 0.3);
    }
    const map::DistanceField field(grid, map::DistanceFieldOptions{});
    Query query;
    query.limits = feasibility::SafetyLimits::of(vessel::Parameters{}, 0.64);
    query.limits.hull_margin_m = 0.05;
    query.limits.speed_max_mps = 0.8;
    query.start.flat.position = {0.0, -11.3};
    query.start.psi_rad = 1.5707963;
    query.goal.flat.position = {0.0, 11.3};
    query.goal.psi_rad = 1.5707963;
    const Plan without = planner.plan(field, query, test::byIterations());
    if (without.outcome != Outcome::kSolved) {
      continue;
    }
    query.may_creep = true;
    const Plan plan = planner.plan(field, query, test::byIterations());
    ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
    EXPECT_LE(plan.figures.duration_s, without.figures.duration_s + 1e-9);
    quicker += plan.figures.duration_s < without.figures.duration_s - 1e-3 ? 1 : 0;
    const auto verification = feasibility::verify(plan.trajectory, field, vessel::Parameters{},
                                                  query.start, query.goal, query.limits);
    EXPECT_TRUE(verification.ok) << verification.reason;
  }
  EXPECT_GE(quicker, 1);
}

// Half of the way, or a quarter, ends where the hull can't go on.
TEST(Planner, DoesNotEndEarlyInADeadEnd) {
  map::OccupancyGrid grid = test::openGrid();
  // A pond whose only way on is a slot for the hull's centre, not for the hull.
  test::fill(grid, 2.0, -40.0, 1.0, 39.35);
  test::fill(grid, 2.0, 0.65, 1.0, 39.35);
  test::fill(grid, 4.5, -3.0, 1.0, 6.0);
  const map::DistanceField field(grid, map::DistanceFieldOptions{});
  Query query;
  query.limits = feasibility::SafetyLimits::of(vessel::Parameters{}, 0.55);
  query.limits.hull_margin_m = 0.0;
  query.start.flat.position = {-9.0, 0.0};
  query.goal.flat.position = {9.0, 0.0};
  query.may_end_early = true;
  Planner planner(Options{}, vessel::Parameters{});
  const Plan plan = planner.plan(field, query, test::byIterations());
  EXPECT_NE(plan.outcome, Outcome::kSolved) << plan.left_m;
}

// The way goes by another gap, if there is one; if not, a plan that may end early tries it again.
TEST(Planner, KeepsAwayFromDeadEndsWhereItCan) {
  for (const bool has_other_gap : {false, true}) {
    map::OccupancyGrid grid = test::openGrid();
    test::fill(grid, 0.0, -40.0, 1.0, 38.0);
    test::fill(grid, 0.0, 2.0, 1.0, 10.0);
    test::fill(grid, 0.0, has_other_gap ? 16.0 : 12.0, 1.0, 40.0);
    const map::DistanceField field(grid, map::DistanceFieldOptions{});
    Query query = across();
    query.start.psi_rad = 0.0;
    query.goal.psi_rad = 0.0;
    query.limits.clearance_m = 1.0;
    Planner planner(Options{}, vessel::Parameters{});
    const auto crossing_m = [&] {
      const Plan plan = planner.plan(field, query, test::byIterations());
      for (double t = 0.0; t < plan.trajectory.duration(); t += 0.05) {
        if (plan.trajectory.flat(t).position.x() > 0.5) {
          return plan.trajectory.flat(t).position.y();
        }
      }
      return -100.0;
    };
    EXPECT_NEAR(crossing_m(), 0.0, 2.0);
    query.dead_ends = {{0.5, 0.0}};
    EXPECT_NEAR(crossing_m(), has_other_gap ? 14.0 : -100.0, 2.0);
    query.may_end_early = true;
    EXPECT_NEAR(crossing_m(), has_other_gap ? 14.0 : 0.0, 2.0);
    // Neither start nor goal is cut off by one.
    query.may_end_early = false;
    query.dead_ends = {query.start.flat.position, query.goal.flat.position};
    EXPECT_NEAR(crossing_m(), 0.0, 2.0);
  }
}

// Three walls with gaps of 2 m, each beside the one before; to be crossed slowly.
map::DistanceField slalom() {
  map::OccupancyGrid grid = test::openGrid();
  for (int k = 0; k < 3; ++k) {
    const double middle = k % 2 == 0 ? -2.0 : 2.0;
    test::fill(grid, 6.0 * k, -40.0, 1.0, 39.0 + middle);
    test::fill(grid, 6.0 * k, middle + 1.0, 1.0, 39.0 - middle);
  }
  return map::DistanceField(grid, map::DistanceFieldOptions{});
}
Query throughTheGaps() {
  Query query;
  query.limits = feasibility::SafetyLimits::of(vessel::Parameters{}, 0.74);
  query.limits.speed_max_mps = 0.8;
  query.start.flat.position = {-12.0, -2.0};
  query.goal.flat.position = {25.0, -2.0};
  return query;
}

// Where the trees don't meet at once, the guide path itself is had for less than their samples.
TEST(Planner, TakesTheGuidePathBeforeManySamples) {
  const map::DistanceField field = slalom();
  Planner planner(Options{}, vessel::Parameters{});
  for (const double speed_mps : {0.0, 0.7}) {
    Query query = throughTheGaps();
    query.start.flat.velocity.x() = speed_mps;
    const Plan plan = planner.plan(field, query, test::byIterations());
    ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
    EXPECT_LT(plan.figures.samples, 60) << speed_mps;
    EXPECT_TRUE(verifyPlan(plan, field, query).ok);
  }
}

// Under way another clearance is soon tried; from rest all that there is is spent.
TEST(Planner, GivesUpSoonUnderWay) {
  const map::DistanceField field = slalom();
  Planner planner(Options{}, vessel::Parameters{});
  Query query = throughTheGaps();
  query.limits.hull_margin_m = 0.45;
  const Plan from_rest = planner.plan(field, query, test::byIterations());
  ASSERT_EQ(from_rest.outcome, Outcome::kNoPath);
  EXPECT_GT(from_rest.figures.samples, 1000);
  query.start.flat.velocity.x() = 0.7;
  const Plan under_way = planner.plan(field, query, test::byIterations());
  ASSERT_EQ(under_way.outcome, Outcome::kNoPath);
  EXPECT_LT(under_way.figures.samples, 150);
}

TEST(Planner, SaysThatTheTimeIsUp) {
  const map::DistanceField field = test::islands();
  Planner planner(Options{}, vessel::Parameters{});
  Termination termination = test::byIterations();
  termination.elapsed_s = [] { return 2.0; };
  termination.budget_s = 1.0;
  EXPECT_EQ(planner.plan(field, across(), termination).outcome, Outcome::kTimeUp);
}

TEST(Planner, PlansFromAMovingStartAndKeepsTheJoint) {
  const map::DistanceField field = test::islands();
  Planner planner(Options{}, vessel::Parameters{});
  const Plan first = planner.plan(field, across(), test::byIterations());
  ASSERT_EQ(first.outcome, Outcome::kSolved);
  Query query = across();
  const double when = 0.5 * first.trajectory.duration();
  query.start.flat = first.trajectory.flat(when);
  query.start.psi_rad = first.trajectory.sample(when, vessel::Parameters{}).state[vessel::kPsi];
  ASSERT_GT(query.start.flat.velocity.norm(), 1.0);
  const Plan second = planner.plan(field, query, test::byIterations());
  ASSERT_EQ(second.outcome, Outcome::kSolved) << second.reason;
  const vessel::FlatPoint joint = second.trajectory.flat(0.0);
  EXPECT_LT((joint.velocity - query.start.flat.velocity).norm(), 1e-6);
  EXPECT_LT((joint.jerk - query.start.flat.jerk).norm(), 1e-6);
  EXPECT_TRUE(verifyPlan(second, field, query).ok);
}

TEST(Planner, IsNoWorseThanItsWarmStart) {
  const map::DistanceField field = test::islands();
  Planner planner(Options{}, vessel::Parameters{});
  const Plan first = planner.plan(field, across(), test::byIterations());
  ASSERT_EQ(first.outcome, Outcome::kSolved);
  Query query = across();
  query.warm_start = first.trajectory;
  query.seed = 77;
  const Plan second = planner.plan(field, query, test::byIterations());
  ASSERT_EQ(second.outcome, Outcome::kSolved);
  EXPECT_LE(second.trajectory.duration(), first.trajectory.duration() + 1.0);
}

TEST(PlannerOptions, ShippedFilesLoad) {
  const auto options = loadOptions(std::string(OTTER_NAV_SOURCE_DIR) + "/config");
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(config::toYaml(*options), config::toYaml(Options{}));
}

}  // namespace
}  // namespace otter_nav::planner
