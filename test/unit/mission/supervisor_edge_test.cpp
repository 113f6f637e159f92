// The vessel over the map's edge: it turns back or holds, and the mission goes on.
#include <gtest/gtest.h>

#include "scripted_mission.hpp"

namespace otter_nav::mission {
namespace {

using test::ScriptedMission;

// The map ends at x = 50 m.
ScriptedMission outside() {
  ScriptedMission mission;
  mission.rest << 51.5, 0.0, 1.0, 0.0, 0.0, 0.0;
  return mission;
}

TEST(MapEdge, TurnsBackFromRestAndPlansInside) {
  ScriptedMission mission = outside();
  const auto orders = mission.goTo({20.0, 0.0});
  ASSERT_TRUE(orders && orders->sail);
  EXPECT_FALSE(orders->plan);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kTurningBack);
  Orders next;
  for (int k = 0; k < 600 && !next.plan; ++k) {
    next = mission.update(0.1);
    EXPECT_FALSE(next.stop);
  }
  ASSERT_TRUE(next.plan);
  EXPECT_GE(mission.field.clearance(next.plan->query.start.flat.position), mission.clearance(3));
  (void)mission.answer(*next.plan, test::eastward(next.plan->query.start.flat.position, 20.0, 3.0));
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
}

TEST(MapEdge, HoldsWhereThereIsNoWayBackAndDoesNotFail) {
  ScriptedMission mission = outside();
  mission.put({30.0, -49.9}, {49.9, 49.9});
  const auto orders = mission.goTo({20.0, 0.0});
  ASSERT_TRUE(orders);
  for (int k = 0; k < 300; ++k) {
    const Orders next = mission.update(0.1);
    EXPECT_FALSE(next.plan || next.sail || next.stop);
  }
  EXPECT_EQ(mission.supervisor->phase(), Phase::kPlanning);
  EXPECT_NE(mission.supervisor->reason().find("edge"), std::string::npos);
  // It drifts back in.
  mission.rest << 0.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  (void)mission.update(0.6);
  EXPECT_TRUE(mission.update(0.6).plan || mission.supervisor->phase() == Phase::kPlanning);
}

TEST(MapEdge, StopsWhenItIsSetOutsideFarOffItsTrajectory) {
  ScriptedMission mission;
  mission.setOut(6.0);
  Situation astray = mission.situation();
  astray.state[vessel::kY] = 52.0;
  astray.tracking_error_m = 52.0;
  EXPECT_TRUE(mission.supervisor->update(mission.now_s, astray, mission.field).stop);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopping);
  astray.state.tail<3>().setZero();
  astray.odometry_stamp_s = mission.now_s + 0.1;
  (void)mission.supervisor->update(mission.now_s + 0.1, astray, mission.field);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kStopped);
  astray.odometry_stamp_s = mission.now_s + 0.2;
  EXPECT_TRUE(mission.supervisor->update(mission.now_s + 0.2, astray, mission.field).sail);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kTurningBack);
}

TEST(MapEdge, FollowsATrajectoryThatLeadsBackIn) {
  ScriptedMission mission;
  mission.setOut(6.0);
  Situation beside = mission.situation();
  beside.state[vessel::kY] = 50.2;
  beside.tracking_error_m = 0.5;
  const Orders orders = mission.supervisor->update(mission.now_s, beside, mission.field);
  EXPECT_FALSE(orders.plan || orders.sail || orders.stop);
  EXPECT_EQ(mission.supervisor->phase(), Phase::kSailing);
}

}  // namespace
}  // namespace otter_nav::mission
