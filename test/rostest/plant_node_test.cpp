// plant_node alone in lockstep: time goes on with each command and no further, and not past a scan
// that has not been acknowledged.
#include <gtest/gtest.h>
#include <otter_nav/PlantState.h>
#include <otter_nav/ThrusterCommand.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Header.h>

#include <cmath>
#include <limits>

#include "support.hpp"

namespace otter_nav::rostest {
namespace {

constexpr double kPeriodS = 0.01;
constexpr double kThrustN = 30.0;

class PlantNode : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(waitUntil([&] {
      return commands_.getNumSubscribers() > 0 && acknowledgements_.getNumSubscribers() > 0;
    }));
    ASSERT_TRUE(odometry_.waitFor([](const auto&) { return true; }));
  }

  void command(const ros::Time& stamp, double thrust_n) {
    ThrusterCommand message;
    message.header.frame_id = ros_bridge::frames().base;
    message.header.stamp = stamp;
    message.left = thrust_n;
    message.right = thrust_n;
    commands_.publish(message);
  }
  void acknowledge(const ros::Time& stamp) {
    std_msgs::Header message;
    message.frame_id = "planner_node";
    message.stamp = stamp;
    acknowledgements_.publish(message);
  }
  ros::Time now() const { return odometry_.messages.back().header.stamp; }
  // Waits for the odometry of a step after `stamp`.
  bool stepAfter(const ros::Time& stamp, double patience_s) {
    return waitUntil([&] { return now() > stamp; }, patience_s);
  }

  ros::NodeHandle node_;
  ros::Publisher commands_ = node_.advertise<ThrusterCommand>("thruster_command", 10);
  ros::Publisher acknowledgements_ = node_.advertise<std_msgs::Header>("lockstep_ack", 10);
  Inbox<nav_msgs::Odometry> odometry_{node_, "odom"};
  Inbox<PlantState> states_{node_, "plant_state"};
  Inbox<sensor_msgs::LaserScan> scans_{node_, "scan"};
  Inbox<rosgraph_msgs::Clock> clocks_{node_, "/clock"};
};

TEST_F(PlantNode, StepsWithItsCommandsAndAcknowledgements) {
  const ros::Time start = now();
  EXPECT_NEAR(odometry_.messages.back().pose.pose.position.x, 1.0, 1e-6);
  EXPECT_NEAR(odometry_.messages.back().pose.pose.position.y, 2.0, 1e-6);
  // The first scan is not acknowledged: a command does not move time.
  command(start, kThrustN);
  EXPECT_FALSE(stepAfter(start, 0.6));
  acknowledge(start);
  ASSERT_TRUE(stepAfter(start, kPatienceS));
  // Nor does an acknowledgement without the command, one for another step, or one that is no
  // number.
  const ros::Time second = now();
  EXPECT_NEAR((second - start).toSec(), kPeriodS, 1e-6);
  acknowledge(ros::TIME_MAX);
  command(start, kThrustN);
  command(second, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(stepAfter(second, 0.6));

  scans_.messages.clear();
  for (int i = 0; i < 200; ++i) {
    const ros::Time stamp = now();
    command(stamp, kThrustN);
    ASSERT_TRUE(stepAfter(stamp, kPatienceS)) << i;
    ASSERT_NEAR((now() - stamp).toSec(), kPeriodS, 1e-6);
  }
  EXPECT_NEAR((now() - start).toSec(), 201 * kPeriodS, 1e-6);
  // Two seconds under thrust: ahead along the heading, and scans at 15 Hz.
  ASSERT_TRUE(states_.waitFor([&](const auto& state) { return state.header.stamp == now(); }));
  const PlantState& state = states_.messages.back();
  EXPECT_GT(state.u, 1.0);
  EXPECT_NEAR(std::atan2(state.y - 2.0, state.x - 1.0), 0.5, 0.05);
  EXPECT_TRUE(clocks_.waitFor([&](const auto& clock) { return clock.clock == now(); }));
  EXPECT_NEAR(static_cast<double>(scans_.messages.size()), 30.0, 2.0);
  EXPECT_EQ(scans_.messages.back().ranges.size(), 720U);
}

}  // namespace
}  // namespace otter_nav::rostest

OTTER_NAV_ROSTEST_MAIN("plant_node_test")
