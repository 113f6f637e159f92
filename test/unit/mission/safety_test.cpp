#include "mission/safety.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace otter_nav::mission {
namespace {

constexpr double kWideWater = 100.0;  // m

TEST(Safety, PlansMayUseLessThrustTheMoreTheWindTakes) {
  const double calm = SupervisorOptions{}.thrust_share;
  EXPECT_NEAR(planThrustShare(calm, 0.0, 0), calm, 1e-9);
  EXPECT_NEAR(planThrustShare(calm, 0.1, 0), 0.75, 1e-9);
  EXPECT_NEAR(planThrustShare(calm, 0.1, 1), 0.65, 1e-9);
  EXPECT_NEAR(planThrustShare(calm, 0.11, 0), 0.7, 1e-9);  // in steps
  EXPECT_NEAR(planThrustShare(calm, 2.0, 5), 0.4, 1e-9);
}

TEST(Safety, ClearancesAreTheListsInCalmWater) {
  const SupervisorOptions options;
  for (std::size_t k = 0; k < options.side_clearances_m.size(); ++k) {
    EXPECT_DOUBLE_EQ(planClearance(options, k, 0.0, 0.95, vessel::Hull{}, kWideWater),
                     centreClearance(vessel::Hull{}, options.side_clearances_m[k]));
  }
}

TEST(Safety, ClearancesGrowWithTheWindAndStayInOrder) {
  const SupervisorOptions options;
  const vessel::Hull hull;
  double calmer = 0.0;
  for (const double share : {0.02, 0.1, 0.3, 0.5, 1.5}) {
    double wider = kWideWater;
    for (std::size_t k = 0; k < options.side_clearances_m.size(); ++k) {
      const double clearance = planClearance(options, k, share, 0.5, hull, kWideWater);
      EXPECT_LT(clearance, wider);
      wider = clearance;
    }
    EXPECT_GE(wider, calmer);  // the narrowest
    calmer = wider;
  }
  // No heading reaches further than the corners.
  EXPECT_NEAR(calmer, 0.8 + 0.5 * (std::hypot(hull.length_m, hull.beam_m) - hull.beam_m), 1e-9);
}

TEST(Safety, AsksForNoMoreThanStartAndGoalHave) {
  const SupervisorOptions options;
  const vessel::Hull hull;
  EXPECT_DOUBLE_EQ(planClearance(options, 0, 0.3, 0.5, hull, 2.0), 2.0);
  EXPECT_DOUBLE_EQ(planClearance(options, 3, 0.3, 0.5, hull, 0.5), 0.8);
}

// A wider hull is kept as far from everything, beside it.
TEST(Safety, ClearancesGrowWithTheBeam) {
  vessel::Parameters wam_v;
  wam_v.hull = {4.9, 2.44};
  const SupervisorOptions options;
  Safety safety(options, wam_v);
  EXPECT_NEAR(safety.narrowest(), 1.22 + 0.26, 1e-12);
  EXPECT_NEAR(safety.critical(), 1.22 + 0.11, 1e-12);
  const feasibility::SafetyLimits limits = safety.limits(0.95, kWideWater);
  EXPECT_NEAR(limits.clearance_m, 1.22 + 1.06, 1e-12);
  EXPECT_EQ(limits.hull.length_m, 4.9);
  EXPECT_LT(limits.speed_max_mps, 0.95 * wam_v.top_speed_mps);
}

TEST(Safety, TakesTheFirstLevelThatStartAndGoalHaveRoomFor) {
  const SupervisorOptions options;
  Safety safety(options, vessel::Parameters{});
  EXPECT_NEAR(safety.limits(0.95, 1.0).clearance_m, 0.9, 1e-12);
  EXPECT_TRUE(safety.refused(false));
  EXPECT_NEAR(safety.limits(0.95, kWideWater).clearance_m, 0.8, 1e-12);
  EXPECT_FALSE(safety.refused(false));  // all were tried
  EXPECT_NEAR(safety.limits(0.95, kWideWater).clearance_m, 1.6, 1e-12);
}

}  // namespace
}  // namespace otter_nav::mission
