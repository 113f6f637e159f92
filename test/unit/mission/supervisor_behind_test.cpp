// A vessel that can't keep up with what it sails.
#include <gtest/gtest.h>

#include "scripted_mission.hpp"

namespace otter_nav::mission {
namespace {

class Behind : public ::testing::Test {
 protected:
  void SetUp() override {
    mission_.setOut(6.0);
    (void)mission_.update(0.1);
  }
  // Off its trajectory, as seen along the way, which leads east, and that much slower.
  Orders updateOff(double ahead_m, double aside_m, double faster_mps) {
    mission_.now_s += 0.1;
    Situation s = mission_.situation();
    s.state.head<2>() += Eigen::Vector2d(ahead_m, aside_m);
    s.state[vessel::kSurge] += faster_mps;
    s.tracking_error_m = std::hypot(ahead_m, aside_m);
    return mission_.supervisor->update(mission_.now_s, s, mission_.obstacles());
  }
  [[nodiscard]] double startTime() const { return mission_.supervisor->sailed().start_time_s; }

  test::ScriptedMission mission_;
};

TEST_F(Behind, SailsTheSameWayLater) {
  const double began_s = startTime();
  const trajectory::Trajectory before = mission_.supervisor->sailed().trajectory;
  const double speed = before.flat(mission_.now_s + 0.1 - began_s).velocity.norm();
  const Orders orders = updateOff(-0.3, 0.05, -0.2);
  ASSERT_TRUE(orders.sail);
  EXPECT_FALSE(orders.plan);
  EXPECT_FALSE(orders.stop);
  EXPECT_EQ(mission_.supervisor->phase(), Phase::kSailing);
  EXPECT_NEAR(startTime() - began_s, 0.3 / speed, 1e-6);
  EXPECT_EQ(orders.sail->start_time_s, startTime());
  EXPECT_EQ(orders.sail->trajectory.duration(), before.duration());
}

TEST_F(Behind, SailsOnWhereItComesBackByItself) {
  const double began_s = startTime();
  EXPECT_FALSE(updateOff(-0.3, 0.0, 0.1).sail);    // fast enough
  EXPECT_FALSE(updateOff(-0.12, 0.0, -0.2).sail);  // waves
  EXPECT_FALSE(updateOff(0.0, 0.4, 0.0).sail);     // beside it
  EXPECT_FALSE(updateOff(0.4, 0.0, -0.2).sail);    // ahead
  EXPECT_EQ(startTime(), began_s);
}

// Put off again and again the plan asks for too much: the next one has less thrust.
TEST_F(Behind, PlansWithLessThrustInTheEnd) {
  std::optional<PlanRequest> plan;
  int put_off = 0;
  while (!plan && put_off < 12) {
    const Orders orders = updateOff(-0.3, 0.0, -0.2);
    plan = orders.plan;
    put_off += orders.sail ? 1 : 0;
  }
  ASSERT_TRUE(plan);
  EXPECT_EQ(put_off, 5);  // 1.2 m, and what counts as made good meanwhile
  EXPECT_EQ(mission_.supervisor->reason(), "far off the trajectory");
  EXPECT_LT(plan->thrust_share, mission_.options.thrust_share);
}

// As it does now and then, that is no reason.
TEST_F(Behind, KeepsThePlanForWhatHappensSeldom) {
  for (int k = 0; k < 5; ++k) {
    const Orders orders = updateOff(-0.25, 0.0, -0.2);
    EXPECT_TRUE(orders.sail) << k;
    EXPECT_FALSE(orders.plan) << k;
    mission_.now_s += 2.4;
  }
}

}  // namespace
}  // namespace otter_nav::mission
