// What the supervisor makes of wind and current.
#include <gtest/gtest.h>

#include <vector>

#include "otter_nav/vessel/parameters.hpp"
#include "scripted_mission.hpp"

namespace otter_nav::mission {
namespace {

using test::ScriptedMission;

TEST(SupervisorInWind, KeepsThrustAndDistanceForTheDisturbance) {
  ScriptedMission mission;
  const auto calm = mission.goTo({20.0, 0.0});
  ASSERT_TRUE(calm && calm->plan);
  EXPECT_DOUBLE_EQ(calm->plan->thrust_share, mission.options.thrust_share);
  Situation windy = mission.situation();
  windy.disturbance_n = 22.0;  // of 100 N
  const auto orders =
      mission.supervisor.setGoal(mission.now_s, {{20.0, 0.0}, 0.0}, windy, mission.field);
  ASSERT_TRUE(orders && orders->plan);
  EXPECT_NEAR(orders->plan->thrust_share, 0.5, 1e-9);
  EXPECT_GT(orders->plan->query.limits.clearance_m, calm->plan->query.limits.clearance_m + 1.0);
}

TEST(SupervisorInWind, PlansMoreGentlyAfterTheVesselCouldNotFollow) {
  ScriptedMission mission;
  mission.setOut(6.0);
  Situation behind = mission.situation();
  behind.state.x() -= 2.0;
  behind.tracking_error_m = 2.0;
  const Orders orders = mission.supervisor.update(mission.now_s, behind, mission.field);
  ASSERT_TRUE(orders.plan);
  EXPECT_NEAR(orders.plan->thrust_share, mission.options.thrust_share - 0.1, 1e-9);
  // It begins where the vessel is, with no more force than the plan may use.
  EXPECT_LT((orders.plan->query.start.flat.position - behind.state.head<2>()).norm(), 2.0);
  const vessel::Parameters otter;
  const Eigen::Vector2d force = otter.paper.m1_kg * orders.plan->query.start.flat.acceleration +
                                otter.paper.d2_kgps * orders.plan->query.start.flat.velocity;
  EXPECT_LE(force.norm(), 2.0 * otter.thrusters.ahead_max_n * orders.plan->thrust_share);
}

// A new plan from where the vessel is, with less thrust; not for each gust again.
TEST(SupervisorInWind, ReplansWhenTheWindTakesWhatThePlanCountsOn) {
  ScriptedMission mission;
  mission.setOut(6.0);
  Situation windy = mission.situation();
  windy.disturbance_n = 4.0;  // of 100 N: the plan left that
  EXPECT_FALSE(mission.supervisor.update(mission.now_s, windy, mission.field).plan);
  windy.disturbance_n = 15.0;
  const Orders orders = mission.supervisor.update(mission.now_s, windy, mission.field);
  ASSERT_TRUE(orders.plan);
  EXPECT_EQ(mission.supervisor.phase(), Phase::kReplanning);
  EXPECT_TRUE(orders.plan->moving);
  EXPECT_NEAR(orders.plan->thrust_share, 0.65, 1e-9);
  ASSERT_TRUE(mission
                  .answer(*orders.plan, test::eastward(orders.plan->query.start.flat.position, 50.0,
                                                       orders.plan->query.start.flat.velocity.x()))
                  .sail);
  windy = mission.situation();
  windy.disturbance_n = 30.0;
  EXPECT_FALSE(mission.supervisor.update(mission.now_s + 1.0, windy, mission.field).plan);
  windy.odometry_stamp_s = mission.now_s + 4.0;
  EXPECT_TRUE(mission.supervisor.update(mission.now_s + 4.0, windy, mission.field).plan);
}

TEST(SupervisorInWind, AllowsMoreThrustWhereThereIsNoPlanWithLess) {
  ScriptedMission mission;
  mission.setOut(6.0);
  Situation windy = mission.situation();
  windy.disturbance_n = 20.0;
  std::vector<double> shares;
  for (int k = 0; k < 9; ++k) {
    const Orders orders = mission.supervisor.update(mission.now_s, windy, mission.field);
    ASSERT_TRUE(orders.plan);
    shares.push_back(orders.plan->thrust_share);
    (void)mission.refuse(*orders.plan, "too fast");
  }
  for (std::size_t k = 0; k < shares.size(); ++k) {  // once for each clearance
    EXPECT_NEAR(shares[k], 0.55 + 0.1 * static_cast<double>(k / 4), 1e-9);
  }
}

// That plan is not replaced for what was conceded to it, but for more wind.
TEST(SupervisorInWind, KeepsAPlanThatWasAllowedMoreThrust) {
  ScriptedMission mission;
  mission.setOut(6.0);
  Situation windy = mission.situation();
  windy.disturbance_n = 20.0;
  Orders orders;
  for (int k = 0; k < 9; ++k) {
    orders = mission.supervisor.update(mission.now_s, windy, mission.field);
    ASSERT_TRUE(orders.plan);
    if (k < 8) {
      (void)mission.refuse(*orders.plan, "too fast");
    }
  }
  ASSERT_NEAR(orders.plan->thrust_share, 0.75, 1e-9);
  ASSERT_TRUE(mission
                  .answer(*orders.plan, test::eastward(orders.plan->query.start.flat.position, 50.0,
                                                       orders.plan->query.start.flat.velocity.x()))
                  .sail);
  windy = mission.situation();
  windy.odometry_stamp_s = mission.now_s + 4.0;
  windy.disturbance_n = 20.0;
  EXPECT_FALSE(mission.supervisor.update(mission.now_s + 4.0, windy, mission.field).plan);
  windy.disturbance_n = 30.0;
  EXPECT_TRUE(mission.supervisor.update(mission.now_s + 4.0, windy, mission.field).plan);
}

TEST(SupervisorInWind, LaunchesAVesselAgainThatHasHardlyGotUnderWay) {
  for (const double surge : {0.1, 1.5}) {
    ScriptedMission mission;
    mission.setOut(6.0);
    Situation windy = mission.situation();
    windy.state[vessel::kSurge] = surge;
    windy.disturbance_n = 15.0;
    const Orders orders = mission.supervisor.update(mission.now_s, windy, mission.field);
    ASSERT_TRUE(orders.plan);
    EXPECT_EQ(trajectory::atRest(orders.plan->query.start), surge < 1.0);
  }
}

}  // namespace
}  // namespace otter_nav::mission
