// Plans under a speed limit: never above it, and near it where there is way to.
#include <gtest/gtest.h>

#include <filesystem>

#include "../../unit/planner/planner_ground.hpp"
#include "islands.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"

namespace otter_nav::planner {
namespace {

const std::filesystem::path kVessels =
    std::filesystem::path(OTTER_NAV_SOURCE_DIR) / "config/vessels";

struct Speeds {
  double fastest = 0.0;
  double cruise = 0.0;  // mean of the way but for the first and last 10 m
};

Speeds speedsOf(const trajectory::Trajectory& trajectory) {
  constexpr double kStepS = 0.02;
  constexpr double kEndsM = 10.0;
  const double length = trajectory::length(trajectory);
  double way = 0.0;
  double from_s = -1.0;
  double from_m = 0.0;
  Speeds speeds;
  for (double t = 0.0; t <= trajectory.duration(); t += kStepS) {
    const double speed = trajectory.flat(t).velocity.norm();
    speeds.fastest = std::max(speeds.fastest, speed);
    way += speed * kStepS;
    if (from_s < 0.0 && way >= kEndsM) {
      from_s = t;
      from_m = way;
    }
    if (from_s >= 0.0 && way <= length - kEndsM) {
      speeds.cruise = (way - from_m) / std::max(t - from_s, kStepS);
    }
  }
  return speeds;
}

struct Case {
  const char* vessel;
  double limit_mps;
};

class SpeedLimit : public ::testing::TestWithParam<Case> {
 protected:
  SpeedLimit()
      : vessel_(*vessel::loadParameters(kVessels / (std::string(GetParam().vessel) + ".yaml"))) {}

  void expectNearTheLimit(const map::DistanceField& field, Query query, double share) {
    query.limits = feasibility::SafetyLimits::of(vessel_);
    query.limits.speed_max_mps = GetParam().limit_mps;
    Planner planner(Options{}, vessel_);
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      query.seed = seed;
      const Plan plan = planner.plan(field, query, test::byIterations());
      ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
      const auto verification = feasibility::verify(plan.trajectory, field, vessel_, query.start,
                                                    query.goal, query.limits);
      EXPECT_TRUE(verification.ok) << verification.reason;
      const Speeds speeds = speedsOf(plan.trajectory);
      EXPECT_LE(speeds.fastest, query.limits.speed_max_mps);
      EXPECT_GE(speeds.cruise, share * query.limits.speed_max_mps) << speeds.fastest;
    }
  }

  vessel::Parameters vessel_;
};

TEST_P(SpeedLimit, IsKeptAndUsedOnOpenWater) {
  Query query;
  query.start.flat.position = {-35.0, -30.0};
  query.start.psi_rad = 2.0;
  query.goal.flat.position = {35.0, 30.0};
  query.goal.psi_rad = -2.0;
  expectNearTheLimit(test::openWater(), query, 0.95);
}

TEST_P(SpeedLimit, IsKeptAndUsedAmongIslands) {
  Query query;
  query.start.flat.position = {-30.0, -5.0};
  query.start.psi_rad = 1.0;
  query.goal.flat.position = {30.0, 5.0};
  query.goal.psi_rad = -2.0;
  expectNearTheLimit(test::islands(), query, 0.95);
}

// A limit that fell under way: the plan slows down, and then keeps to it.
TEST_P(SpeedLimit, IsReachedFromAbove) {
  const double limit = GetParam().limit_mps;
  const double fast = std::min(2.0 * limit, 0.9 * vessel_.top_speed_mps);
  const map::DistanceField field = test::openWater();
  Query query;
  query.start.flat.position = {-35.0, -30.0};
  query.start.flat.velocity = {fast, 0.0};
  query.goal.flat.position = {30.0, 25.0};
  query.limits = feasibility::SafetyLimits::of(vessel_);
  query.limits.speed_max_mps = limit;
  Planner planner(Options{}, vessel_);
  const Plan plan = planner.plan(field, query, test::byIterations());
  ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
  const auto verification =
      feasibility::verify(plan.trajectory, field, vessel_, query.start, query.goal, query.limits);
  EXPECT_TRUE(verification.ok) << verification.reason;
  constexpr double kSlowedS = 12.0;
  double fastest = 0.0;
  for (double t = kSlowedS; t < plan.trajectory.duration(); t += 0.02) {
    fastest = std::max(fastest, plan.trajectory.flat(t).velocity.norm());
  }
  EXPECT_LE(fastest, limit);
  // All of it has its price, the slowing down too.
  double cost = 0.0;
  constexpr double kStepS = 1e-3;
  for (double t = 0.5 * kStepS; t < plan.trajectory.duration(); t += kStepS) {
    cost += kStepS * (Options{}.sigma + plan.trajectory.flat(t).jerk.squaredNorm());
  }
  EXPECT_NEAR(plan.figures.cost, cost, 1e-3 * cost);
}

// The course over ground that others watch: from rest, a little off the way, the vessel neither
// turns to the other side nor swings about on it.
TEST(SpeedLimitFromRest, HardlyOffTheWayItLeavesStraight) {
  constexpr double kSettledS = 2.0;
  constexpr double kArrivesS = 6.0;
  const vessel::Parameters vessel = *vessel::loadParameters(kVessels / "otter.yaml");
  const map::DistanceField field = test::openWater();
  Planner planner(Options{}, vessel);
  for (const double off_rad : {-0.05, -0.025, 0.025, 0.05}) {
    Query query;
    query.start.flat.position = {-35.0, 0.0};
    query.start.psi_rad = off_rad;
    query.goal.flat.position = {35.0, 0.0};
    query.limits = feasibility::SafetyLimits::of(vessel);
    query.limits.speed_max_mps = 1.96;
    const Plan plan = planner.plan(field, query, test::byIterations());
    ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
    double swings_rad = 0.0;
    for (double t = kSettledS; t < plan.trajectory.duration() - kArrivesS; t += 0.1) {
      const Eigen::Vector2d velocity = plan.trajectory.flat(t).velocity;
      swings_rad = std::max(swings_rad, std::abs(std::atan2(velocity.y(), velocity.x())));
    }
    EXPECT_LT(swings_rad, 0.055) << off_rad;
  }
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* vessel : {"otter_gazebo", "otter", "wam_v"}) {
    for (const double limit : {0.3, 0.5, 0.8, 1.0, 1.3, 1.7, 2.2}) {
      all.push_back({vessel, limit});
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Limits, SpeedLimit, ::testing::ValuesIn(cases()), [](const auto& c) {
  return std::string(c.param.vessel) + "_" +
         std::to_string(static_cast<int>(100.0 * c.param.limit_mps));
});

}  // namespace
}  // namespace otter_nav::planner
