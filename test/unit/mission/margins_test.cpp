#include "otter_nav/mission/margins.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace otter_nav::mission {
namespace {

constexpr double kWideWater = 100.0;  // m

TEST(Margins, PlansMayUseLessThrustTheMoreTheWindTakes) {
  const MarginOptions options;
  EXPECT_NEAR(planThrustShare(options, 0.0, 0), options.thrust_share, 1e-9);
  EXPECT_NEAR(planThrustShare(options, 0.1, 0), 0.75, 1e-9);
  EXPECT_NEAR(planThrustShare(options, 0.1, 1), 0.65, 1e-9);
  EXPECT_NEAR(planThrustShare(options, 0.11, 0), 0.7, 1e-9);  // in steps
  EXPECT_NEAR(planThrustShare(options, 2.0, 5), options.thrust_share_min, 1e-9);
}

TEST(Margins, ClearancesAreTheListsInCalmWater) {
  const MarginOptions options;
  for (std::size_t k = 0; k < options.plan_clearances_m.size(); ++k) {
    EXPECT_DOUBLE_EQ(planClearance(options, k, 0.0, 0.95, vessel::Hull{}, kWideWater),
                     options.plan_clearances_m[k]);
  }
}

TEST(Margins, ClearancesGrowWithTheWindAndStayInOrder) {
  const MarginOptions options;
  const vessel::Hull hull;
  double calmer = 0.0;
  for (const double share : {0.02, 0.1, 0.3, 0.5, 1.5}) {
    double wider = kWideWater;
    for (std::size_t k = 0; k < options.plan_clearances_m.size(); ++k) {
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

TEST(Margins, AsksForNoMoreThanStartAndGoalHave) {
  const MarginOptions options;
  const vessel::Hull hull;
  EXPECT_DOUBLE_EQ(planClearance(options, 0, 0.3, 0.5, hull, 2.0), 2.0);
  EXPECT_DOUBLE_EQ(planClearance(options, 3, 0.3, 0.5, hull, 0.5), 0.8);
}

}  // namespace
}  // namespace otter_nav::mission
