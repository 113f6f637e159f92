// The mission's speed limit, set at rest and under way.
#include <gtest/gtest.h>

#include "otter_nav/stopping/splice.hpp"
#include "scripted_mission.hpp"

namespace otter_nav::mission {
namespace {

using test::beginsUnderWay;
using test::ScriptedMission;

TEST(SupervisorSpeed, LimitsPlansFromRest) {
  SupervisorOptions options;
  options.speed_max_mps = 2.0;
  ScriptedMission mission(test::openWater(), options);
  mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  EXPECT_NEAR(mission.goTo({40.0, 0.0})->plan->query.limits.speed_max_mps, 0.98 * 2.0, 1e-12);
  ASSERT_TRUE(mission.supervisor->setSpeedMax(1.0));
  EXPECT_NEAR(mission.goTo({30.0, 0.0})->plan->query.limits.speed_max_mps, 0.98, 1e-12);
  // Less than a vessel can steer by is refused and leaves the limit as it was.
  EXPECT_FALSE(mission.supervisor->setSpeedMax(0.1));
  EXPECT_FALSE(mission.supervisor->setSpeedMax(-1.0));
  EXPECT_EQ(mission.supervisor->speedMax(), 1.0);
}

TEST(SupervisorSpeed, PlansAnewForALimitSetUnderWay) {
  ScriptedMission mission;
  mission.setOut(6.0);
  EXPECT_FALSE(mission.update(0.1).plan);
  ASSERT_TRUE(mission.supervisor->setSpeedMax(1.0));
  const Orders orders = mission.update(0.1);
  ASSERT_TRUE(orders.plan);
  EXPECT_TRUE(beginsUnderWay(*orders.plan));
  EXPECT_NEAR(orders.plan->query.limits.speed_max_mps, 0.98, 1e-12);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kReplanning);
  // What is taken carries the limit to the tracker, and is the end of it.
  const double from = orders.plan->start_time_s - mission.supervisor->sailed().start_time_s;
  const Orders taken = mission.answer(
      *orders.plan, stopping::remainder(mission.supervisor->sailed().trajectory, from));
  ASSERT_TRUE(taken.sail);
  EXPECT_NEAR(taken.sail->speed_max_mps, 0.98, 1e-12);
  EXPECT_FALSE(mission.update(0.1).plan);
}

TEST(SupervisorSpeed, StopsWhereNoPlanKeepsToALimitSetUnderWay) {
  ScriptedMission mission;
  mission.setOut(6.0);
  ASSERT_TRUE(mission.supervisor->setSpeedMax(1.0));
  for (int i = 0; i < 60 && mission.supervisor->phase() != Phase::kStopping; ++i) {
    const Orders orders = mission.update(0.1);
    if (orders.plan) {
      (void)mission.refuse(*orders.plan, "too fast");
    }
  }
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopping);
  EXPECT_NE(mission.supervisor->reason().find("1.00 m/s"), std::string::npos);
}

// Nothing is planned anew for one that the plan keeps to, but that it may not exceed either when it
// is behind.
TEST(SupervisorSpeed, SailsOnWhereThePlanKeepsToANewLimit) {
  for (const double times : {10.0, 1.03}) {
    ScriptedMission mission;
    const double planned_mps = mission.goTo({40.0, 0.0})->plan->query.limits.speed_max_mps;
    const double limit_mps = times * planned_mps;
    mission.setOut(6.0);
    (void)mission.update(0.1);
    ASSERT_TRUE(mission.supervisor->setSpeedMax(limit_mps));
    for (int i = 0; i < 80; ++i) {
      const Orders orders = mission.update(0.1);
      if (orders.plan) {
        (void)mission.refuse(*orders.plan, "none");
      }
      ASSERT_EQ(mission.supervisor->phase(), Phase::kSailing) << mission.supervisor->reason();
    }
    EXPECT_LE(mission.supervisor->sailed().speed_max_mps, limit_mps);
  }
}

// A higher limit is no hurry: a faster plan is asked for once, and taken if it is faster.
TEST(SupervisorSpeed, LooksForAFasterPlanWhenTheLimitRises) {
  SupervisorOptions options;
  options.speed_max_mps = 4.0;
  ScriptedMission mission(test::openWater(), options);
  mission.setOut(6.0);
  ASSERT_TRUE(mission.supervisor->setSpeedMax(0.0));
  const Orders orders = mission.update(0.1);
  ASSERT_TRUE(orders.plan);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
  (void)mission.refuse(*orders.plan, "none");
  EXPECT_FALSE(mission.update(0.1).plan);
}

// They will have gone soon. What is slow for other reasons, or fast, is left as it is.
TEST(SupervisorSpeed, LooksForAQuickerPlanWhereOthersMadeItSlow) {
  for (const bool has_company : {false, true}) {
    for (const double speed_mps : {1.0, 4.0}) {
      ScriptedMission mission;
      if (has_company) {
        traffic::Track other;
        other.position = {45.0, 45.0};
        mission.tracks = {other};
      }
      mission.rest << -40.0, 0.0, 0.0, 0.0, 0.0, 0.0;
      const Result<Orders> orders = mission.goTo({40.0, 0.0});
      ASSERT_TRUE(
          mission.answer(*orders->plan, test::eastward({-40.0, 0.0}, 80.0, speed_mps)).sail);
      int asked = 0;
      for (int k = 0; k < 100; ++k) {
        if (const Orders next = mission.update(0.1); next.plan) {
          EXPECT_GT(next.plan->query.limits.speed_max_mps, 3.0);
          EXPECT_FALSE(mission.refuse(*next.plan, "none").stop);
          ++asked;
        }
      }
      EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
      EXPECT_EQ(asked, has_company && speed_mps < 2.0 ? 3 : 0) << has_company << speed_mps;
    }
  }
}

}  // namespace
}  // namespace otter_nav::mission
