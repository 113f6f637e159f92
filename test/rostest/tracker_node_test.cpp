// tracker_node alone on its own clock: a command each 10 ms, trajectories taken and refused, and
// what it does when the odometry is not a number or ends.
#include <gtest/gtest.h>
#include <otter_nav/NearObstacles.h>
#include <otter_nav/ThrusterCommand.h>
#include <otter_nav/TrackerCycle.h>
#include <otter_nav/TrackerStatus.h>
#include <otter_nav/Trajectory.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "otter_nav/ros/near_obstacles.hpp"
#include "otter_nav/ros/trajectories.hpp"
#include "otter_nav/tracker/tracker.hpp"
#include "support.hpp"

namespace otter_nav::rostest {
namespace {

// 30 m east in 20 s, from rest to rest.
Trajectory straight(std::uint32_t id, const ros::Time& start) {
  vessel::FlatPoint from;
  vessel::FlatPoint to;
  to.position = {30.0, 0.0};
  const trajectory::Trajectory trajectory({trajectory::hermitePiece(from, to, 20.0)});
  return ros_bridge::toMessage({trajectory, start.toSec()}, id, {{30.0, 0.0}, 0.0},
                               ros_bridge::frames().map, vessel::Parameters());
}

// By which a mission goes into narrow water or waits.
TEST(DisturbanceEstimateMessage, TellsWhetherTheWavesAreKnown) {
  for (const bool known : {false, true}) {
    vessel::DisturbanceEstimate estimate;
    estimate.knows_waves = known;
    const auto told = ros_bridge::disturbanceEstimate(ros_bridge::toMessage(estimate));
    ASSERT_TRUE(told);
    EXPECT_EQ(told->knows_waves, known);
  }
}

// What the tracker foresees comes through, and no part of a message that is wrong anywhere.
TEST(ForeseenMessage, ComesWholeOrNotAtAll) {
  vessel::Foreseen foreseen{12.0, 0.5, {{{1.0, 2.0}, 0.3}, {{1.5, 2.5}, 0.4}}};
  const Foreseen message = ros_bridge::toMessage(foreseen);
  const auto told = ros_bridge::toForeseen(message);
  ASSERT_TRUE(told);
  ASSERT_EQ(told->poses.size(), 2U);
  EXPECT_DOUBLE_EQ(told->start_s, 12.0);
  EXPECT_DOUBLE_EQ(told->step_s, 0.5);
  EXPECT_EQ(told->poses[1].position, foreseen.poses[1].position);
  EXPECT_DOUBLE_EQ(told->poses[1].psi_rad, 0.4);

  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [&](auto spoil) {
    Foreseen spoilt = message;
    spoil(spoilt);
    const auto read = ros_bridge::toForeseen(spoilt);
    return read ? std::string("taken") : read.error().message;
  };
  EXPECT_EQ(refusal([](Foreseen& m) { m.y.pop_back(); }),
            "foreseen: x, y and heading hold 2, 1 and 2");
  EXPECT_EQ(refusal([](Foreseen& m) { m.heading.push_back(0.0); }),
            "foreseen: x, y and heading hold 2, 2 and 3");
  EXPECT_EQ(refusal([](Foreseen& m) { m.step = -0.5; }), "foreseen: step is -0.5 s");
  EXPECT_NE(refusal([&](Foreseen& m) { m.step = nan; }), "taken");
  EXPECT_EQ(refusal([&](Foreseen& m) { m.x[1] = nan; }), "foreseen: place 1 is not finite");
  EXPECT_EQ(refusal([&](Foreseen& m) { m.heading[0] = -nan; }), "foreseen: place 0 is not finite");
}

TEST(NearObstaclesMessage, ComesWholeOrNotAtAll) {
  const tracker::NearObstacles near{12.5, {{1.0, 2.0}, {3.0, 4e6 + 0.25}}};
  const std::string map = ros_bridge::frames().map;
  NearObstacles message = ros_bridge::toMessage(near, 7, map);
  EXPECT_EQ(message.id, 7U);
  const auto told = ros_bridge::toNearObstacles(message, map);
  ASSERT_TRUE(told);
  EXPECT_DOUBLE_EQ(told->start_s, 12.5);
  EXPECT_EQ(told->points, near.points);
  message.x.pop_back();
  const auto cut = ros_bridge::toNearObstacles(message, map);
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().message, "near obstacles: x and y hold 1 and 2");
  EXPECT_FALSE(ros_bridge::toNearObstacles(ros_bridge::toMessage(near, 7, "odom"), map));
}

// The message's constants are the names that the tracker gives its modes.
TEST(TrackerStatusMessage, NamesTheModes) {
  using tracker::Mode;
  const std::pair<Mode, std::string> all[] = {
      {Mode::kIdle, TrackerStatus::IDLE},       {Mode::kTracking, TrackerStatus::TRACKING},
      {Mode::kHolding, TrackerStatus::HOLDING}, {Mode::kStopping, TrackerStatus::STOPPING},
      {Mode::kStopped, TrackerStatus::STOPPED}, {Mode::kFault, TrackerStatus::FAULT}};
  for (const auto& [mode, state] : all) {
    EXPECT_EQ(tracker::name(mode), state);
  }
}

class TrackerNode : public testing::Test {
 protected:
  TrackerNode() {
    timer_ = node_.createWallTimer(ros::WallDuration(0.02), [this](const ros::WallTimerEvent&) {
      if (sending_) {
        odometry_.publish(odometryAt({x_, 0.0}, 0.0, ros::Time::now()));
      }
    });
  }
  void SetUp() override {
    ASSERT_TRUE(waitUntil([&] {
      return odometry_.getNumSubscribers() > 0 && trajectory_.getNumSubscribers() > 0 &&
             near_.getNumSubscribers() > 0;
    }));
    ASSERT_TRUE(commands_.connected());
  }

  ros::NodeHandle node_;
  ros::Publisher odometry_ = node_.advertise<nav_msgs::Odometry>("odom", 10);
  ros::Publisher trajectory_ = node_.advertise<Trajectory>("trajectory", 10);
  ros::Publisher near_ = node_.advertise<NearObstacles>("near_obstacles", 10);
  ros::WallTimer timer_;
  bool sending_ = true;
  double x_ = 0.0;
  Inbox<ThrusterCommand> commands_{node_, "thruster_command"};
  Inbox<TrackerStatus> statuses_{node_, "tracker_status"};
  Inbox<TrackerCycle> cycles_{node_, "tracker_cycle"};
};

TEST_F(TrackerNode, CommandsEachHundredthOfASecond) {
  ASSERT_TRUE(waitUntil([&] { return commands_.messages.size() >= 200; }));
  std::vector<double> steps;
  for (std::size_t i = 1; i < commands_.messages.size(); ++i) {
    steps.push_back(
        (commands_.messages[i].header.stamp - commands_.messages[i - 1].header.stamp).toSec());
  }
  std::sort(steps.begin(), steps.end());
  EXPECT_NEAR(steps[steps.size() / 2], 0.01, 0.001);
}

TEST_F(TrackerNode, SailsATrajectoryThenStopsWhenTheOdometryEnds) {
  trajectory_.publish(straight(7, ros::Time::now()));
  ASSERT_TRUE(statuses_.waitFor([](const auto& status) {
    return status.state == TrackerStatus::TRACKING && status.trajectory_id == 7U;
  }));
  // The vessel does not move, so it is pushed ahead.
  ASSERT_TRUE(commands_.waitFor(
      [](const auto& command) { return command.left > 5.0 && command.right > 5.0; }));

  // Odometry that is not a number is dropped; commands stay numbers.
  nav_msgs::Odometry broken = odometryAt({0.0, 0.0}, 0.0, ros::Time::now());
  broken.pose.pose.position.x = std::numeric_limits<double>::quiet_NaN();
  odometry_.publish(broken);
  broken.header.frame_id = "base_link";
  odometry_.publish(broken);
  commands_.messages.clear();
  ASSERT_TRUE(waitUntil([&] { return commands_.messages.size() >= 50; }));
  for (const auto& command : commands_.messages) {
    ASSERT_TRUE(std::isfinite(command.left) && std::isfinite(command.right));
  }

  sending_ = false;
  statuses_.messages.clear();
  ASSERT_TRUE(statuses_.waitFor([](const auto& status) {
    return (status.state == TrackerStatus::STOPPING || status.state == TrackerStatus::FAULT) &&
           !status.reason.empty();
  }));
  commands_.messages.clear();
  EXPECT_TRUE(commands_.waitFor(
      [](const auto& command) { return command.left == 0.0 && command.right == 0.0; }));
}

// Else all that comes after it would be older, and the vessel sailed by the model alone.
TEST_F(TrackerNode, GoesOnBehindOdometryStampedAhead) {
  const double at = 3.0;
  ASSERT_TRUE(statuses_.waitFor([](const auto&) { return true; }));
  odometry_.publish(odometryAt({x_, 0.0}, 0.0, ros::Time::now() + ros::Duration(1000.0)));
  x_ = at;
  ASSERT_TRUE(cycles_.waitFor([&](const auto& cycle) {
    return cycle.estimate[0] > at - 0.1 && std::abs(cycle.time - cycle.odometry_time) < 0.5;
  }));
  x_ = 0.0;
  ASSERT_TRUE(cycles_.waitFor([&](const auto& cycle) {
    return cycle.time > cycles_.messages.front().time + 1.0 && cycle.estimate[0] < 0.1;
  }));
}

TEST_F(TrackerNode, RefusesMalformedTrajectories) {
  const auto refused = [&](const Trajectory& message, const std::string& word) {
    statuses_.messages.clear();
    trajectory_.publish(message);
    EXPECT_TRUE(statuses_.waitFor([&](const auto& status) {
      return status.refused_id == message.id &&
             status.refused_reason.find(word) != std::string::npos;
    })) << word;
  };
  Trajectory message = straight(21, ros::Time::now());
  message.header.frame_id = "odom";
  refused(message, "frame_id");
  message = straight(22, ros::Time::now());
  message.pieces[0].x[3] = std::numeric_limits<double>::quiet_NaN();
  refused(message, "pieces[0]");
  message = straight(23, ros::Time::now());
  message.pieces[0].duration = -1.0;
  refused(message, "duration");
  message = straight(24, ros::Time::now());
  message.pieces.push_back(message.pieces[0]);
  refused(message, "pieces[1]");
  message = straight(25, ros::Time::now() - ros::Duration(100.0));
  refused(message, "ended");
  // What came under the same id and was taken is not refused any more.
  statuses_.messages.clear();
  trajectory_.publish(straight(25, ros::Time::now()));
  EXPECT_TRUE(statuses_.waitFor([](const auto& status) {
    return status.accepted_id == 25U && status.refused_id != 25U && status.refused_reason.empty();
  }));
}

TEST_F(TrackerNode, TakesNearObstaclesAndKeepsThemWhenItRefusesOthers) {
  NearObstacles message = ros_bridge::toMessage({0.0, {{5.0, 2.0}}}, 3, ros_bridge::frames().map);
  near_.publish(message);
  EXPECT_TRUE(statuses_.waitFor([](const auto& s) { return s.near_obstacles_id == 3U; }));
  EXPECT_TRUE(cycles_.waitFor([](const auto& c) { return c.near_obstacles_taken == 3U; }));
  message.id = 4;
  message.y[0] = std::numeric_limits<double>::quiet_NaN();
  near_.publish(message);
  EXPECT_TRUE(statuses_.waitFor([](const auto& s) { return s.near_obstacles_id == 4U; }));
  cycles_.messages.clear();
  EXPECT_TRUE(cycles_.waitFor([](const auto& c) { return c.near_obstacles_taken == 3U; }));
}

}  // namespace
}  // namespace otter_nav::rostest

OTTER_NAV_ROSTEST_MAIN("tracker_node_test")
