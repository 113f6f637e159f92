// What an operator may ask of a mission: pause, hold, resume, give up.
#include <gtest/gtest.h>

#include "scripted_mission.hpp"

namespace otter_nav::mission {
namespace {

using test::beginsUnderWay;
using test::eastward;
using test::ScriptedMission;

Result<Orders> pause(ScriptedMission& m) {
  return m.supervisor->pause(m.now_s, m.situation(), m.obstacles());
}
Orders hold(ScriptedMission& m) {
  return m.supervisor->hold(m.now_s, m.situation(), m.obstacles());
}
Result<Orders> resume(ScriptedMission& m) {
  return m.supervisor->resume(m.now_s, m.situation(), m.obstacles());
}

// Until the phase is reached; nothing may be planned on the way there.
bool comesTo(Phase phase, ScriptedMission& m) {
  for (int k = 0; k < 300 && m.supervisor->phase() != phase; ++k) {
    // At rest the last trajectory tells where; an order to stop leaves the vessel there.
    m.rest.head<3>() = m.situation().state.head<3>();
    EXPECT_FALSE(m.update(0.1).plan);
  }
  return m.supervisor->phase() == phase;
}

TEST(Pause, BrakesKeepsTheMissionAndGoesOn) {
  ScriptedMission mission;
  mission.setOut(6.0);
  const auto orders = pause(mission);
  ASSERT_TRUE(orders && orders->sail);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopping);
  const trajectory::Trajectory& braking = orders->sail->trajectory;
  EXPECT_LT(braking.flat(braking.duration()).velocity.norm(), 1e-6);
  ASSERT_TRUE(comesTo(Phase::kPaused, mission));
  for (int k = 0; k < 200; ++k) {
    const Orders waiting = mission.update(0.1);
    EXPECT_FALSE(waiting.plan || waiting.sail || waiting.stop);
  }
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPaused);
  EXPECT_EQ(mission.supervisor->stops(), 0);

  const auto on = resume(mission);
  ASSERT_TRUE(on && on->plan);
  EXPECT_FALSE(beginsUnderWay(*on->plan));
  EXPECT_EQ(on->plan->query.goal.flat.position, Eigen::Vector2d(40.0, 0.0));
  const Eigen::Vector2d here = mission.situation().state.head<2>();
  EXPECT_TRUE(mission.answer(*on->plan, eastward(here, 40.0 - here.x(), 3.0)).sail);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
}

TEST(Pause, IsRefusedWithoutAMission) {
  ScriptedMission mission;
  EXPECT_FALSE(pause(mission));
  EXPECT_FALSE(resume(mission));
  EXPECT_EQ(mission.supervisor->phase(), Phase::kIdle);
}

TEST(Pause, BeforeTheFirstPlanKeepsThePlaceAndIgnoresTheAnswer) {
  ScriptedMission mission;
  const auto goal = mission.goTo({40.0, 0.0});
  const auto orders = pause(mission);
  ASSERT_TRUE(orders);
  EXPECT_TRUE(orders->stop);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPaused);
  EXPECT_FALSE(mission.answer(*goal->plan, eastward({0.0, 0.0}, 40.0, 4.0)).sail);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPaused);
}

TEST(Pause, ResumedWhileStillBrakingGoesOnAfterTheStop) {
  ScriptedMission mission;
  mission.setOut(6.0);
  ASSERT_TRUE(pause(mission));
  (void)mission.update(0.5);
  const auto on = resume(mission);
  ASSERT_TRUE(on);
  EXPECT_FALSE(on->plan);
  std::optional<PlanRequest> request;
  for (int k = 0; k < 300 && !request; ++k) {
    request = mission.update(0.1).plan;
  }
  ASSERT_TRUE(request);
  EXPECT_EQ(request->query.goal.flat.position, Eigen::Vector2d(40.0, 0.0));
}

TEST(Pause, EndsWithANewGoal) {
  ScriptedMission mission;
  mission.setOut(6.0);
  ASSERT_TRUE(pause(mission));
  ASSERT_TRUE(comesTo(Phase::kPaused, mission));
  const auto orders = mission.goTo({30.0, 5.0});
  ASSERT_TRUE(orders && orders->plan);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPlanning);
  EXPECT_FALSE(resume(mission));
}

TEST(Pause, EndsWithTheMission) {
  ScriptedMission mission;
  mission.setOut(6.0);
  ASSERT_TRUE(pause(mission));
  const Orders orders = mission.supervisor->cancel(mission.now_s, mission.situation(),
                                                   mission.obstacles(), "stopped by the operator");
  EXPECT_FALSE(orders.plan);
  ASSERT_TRUE(comesTo(Phase::kIdle, mission));
  EXPECT_FALSE(resume(mission));
}

TEST(Hold, KeepsAVesselThatHasNoMission) {
  ScriptedMission mission;
  EXPECT_TRUE(hold(mission).stop);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kHolding);
  const auto on = resume(mission);
  ASSERT_TRUE(on);
  EXPECT_FALSE(on->plan);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kIdle);
}

TEST(Hold, BrakesADriftingVesselFirst) {
  ScriptedMission mission;
  mission.rest[vessel::kSway] = 0.5;
  EXPECT_TRUE(hold(mission).stop);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopping);
  mission.rest[vessel::kSway] = 0.0;
  ASSERT_TRUE(comesTo(Phase::kHolding, mission));
}

TEST(Hold, UnderWayKeepsTheMission) {
  ScriptedMission mission;
  mission.setOut(6.0);
  EXPECT_TRUE(hold(mission).sail);
  ASSERT_TRUE(comesTo(Phase::kHolding, mission));
  ASSERT_TRUE(pause(mission));
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPaused);
  const auto on = resume(mission);
  ASSERT_TRUE(on && on->plan);
}

TEST(Cancel, TellsWhy) {
  ScriptedMission mission;
  mission.setOut(6.0);
  (void)mission.supervisor->cancel(mission.now_s, mission.situation(), mission.obstacles(),
                                   "stopped by the operator");
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopping);
  ASSERT_TRUE(comesTo(Phase::kIdle, mission));
  EXPECT_EQ(mission.supervisor->reason(), "stopped by the operator");
}

}  // namespace
}  // namespace otter_nav::mission
