// planner_node with a map and a vessel that lies still: goals by action, trajectories out, bad
// goals aborted with their reason.
#include <actionlib/client/simple_action_client.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/Path.h>
#include <otter_nav/PlannerStatus.h>
#include <otter_nav/TrackerStatus.h>
#include <otter_nav/Trajectory.h>
#include <ros/master.h>
#include <ros/network.h>
#include <std_srvs/Trigger.h>
#include <visualization_msgs/MarkerArray.h>
#include <xmlrpcpp/XmlRpc.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/ros/trajectories.hpp"
#include "support.hpp"

namespace otter_nav::rostest {
namespace {

using Client = actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction>;
using State = actionlib::SimpleClientGoalState;

const Eigen::Vector2d kStart(-22.0, -8.0);

class PlannerNode : public testing::Test {
 protected:
  PlannerNode() {
    timer_ = node_.createWallTimer(ros::WallDuration(0.02), [this](const ros::WallTimerEvent&) {
      odometry_.publish(odometryAt(kStart, 0.2, ros::Time::now()));
      tellHowFarOff();
    });
  }
  void SetUp() override {
    ASSERT_TRUE(waitUntil([&] { return client_.isServerConnected(); }));
  }

  static move_base_msgs::MoveBaseGoal goal(double x, double y) {
    move_base_msgs::MoveBaseGoal message;
    message.target_pose.header.frame_id = ros_bridge::frames().map;
    message.target_pose.pose = ros_bridge::toPose({{x, y}, 0.5});
    return message;
  }

  // As a tracker that sails the last trajectory, or holds its end, so far off.
  void tellHowFarOff() {
    if (!off_m_ || trajectories_.messages.empty()) {
      return;
    }
    TrackerStatus status;
    status.header.stamp = ros::Time::now();
    status.state = TrackerStatus::TRACKING;
    status.trajectory_id = status.accepted_id = trajectories_.messages.back().id;
    status.position_error = *off_m_;
    tracker_.publish(status);
  }

  // The reason with which the goal is aborted.
  std::string abortReason(const move_base_msgs::MoveBaseGoal& message) {
    client_.sendGoal(message);
    EXPECT_TRUE(waitUntil([&] { return client_.getState().isDone(); }));
    EXPECT_EQ(client_.getState().toString(), "ABORTED");
    return client_.getState().getText();
  }

  // The clearance drawn is as wide as the one told.
  void expectRibbon(const trajectory::Trajectory& trajectory) {
    ASSERT_TRUE(statuses_.waitFor([](const auto& status) { return status.clearance > 0.0; }));
    const double clearance_m = statuses_.messages.back().clearance;
    visualization_msgs::Marker ribbon;
    ASSERT_TRUE(markers_.waitFor([&](const visualization_msgs::MarkerArray& array) {
      for (const visualization_msgs::Marker& marker : array.markers) {
        ribbon = marker.ns == "clearance" ? marker : ribbon;
      }
      return !ribbon.points.empty();
    }));
    double farthest = 0.0;
    for (const geometry_msgs::Point& p : ribbon.points) {
      double nearest = std::numeric_limits<double>::infinity();
      for (double t = 0.0; t < trajectory.duration(); t += 0.05) {
        const Eigen::Vector2d there = trajectory.flat(t).position;
        nearest = std::min(nearest, std::hypot(p.x - there.x(), p.y - there.y()));
      }
      farthest = std::max(farthest, nearest);
    }
    EXPECT_NEAR(farthest, clearance_m, 0.03);
  }

  ros::NodeHandle node_;
  ros::Publisher odometry_ = node_.advertise<nav_msgs::Odometry>("odom", 10);
  ros::Publisher tracker_ = node_.advertise<TrackerStatus>("tracker_status", 10);
  std::optional<double> off_m_;
  ros::WallTimer timer_;
  Inbox<Trajectory> trajectories_{node_, "trajectory"};
  Inbox<PlannerStatus> statuses_{node_, "planner_status"};
  Inbox<visualization_msgs::MarkerArray> markers_{node_, "trajectory_markers"};
  Client client_{"move_base", false};
};

// The message's constants are the names that the mission gives its phases.
TEST(PlannerStatusMessage, NamesThePhases) {
  using mission::Phase;
  const std::pair<Phase, std::string> all[] = {{Phase::kIdle, PlannerStatus::IDLE},
                                               {Phase::kPlanning, PlannerStatus::PLANNING},
                                               {Phase::kSailing, PlannerStatus::SAILING},
                                               {Phase::kReplanning, PlannerStatus::REPLANNING},
                                               {Phase::kStopping, PlannerStatus::STOPPING},
                                               {Phase::kStopped, PlannerStatus::STOPPED},
                                               {Phase::kBackingOff, PlannerStatus::BACKING_OFF},
                                               {Phase::kEvading, PlannerStatus::EVADING},
                                               {Phase::kTurningBack, PlannerStatus::TURNING_BACK},
                                               {Phase::kPaused, PlannerStatus::PAUSED},
                                               {Phase::kHolding, PlannerStatus::HOLDING},
                                               {Phase::kArrived, PlannerStatus::ARRIVED},
                                               {Phase::kFailed, PlannerStatus::FAILED}};
  for (const auto& [phase, state] : all) {
    EXPECT_EQ(mission::name(phase), state);
  }
}

TEST_F(PlannerNode, AbortsBadGoalsWithTheirReason) {
  EXPECT_NE(abortReason(goal(0.0, 2.0)).find("obstacle"), std::string::npos);
  EXPECT_NE(abortReason(goal(100.0, 2.0)).find("outside the map"), std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(abortReason(goal(nan, 2.0)).find("not finite"), std::string::npos);
  move_base_msgs::MoveBaseGoal elsewhere = goal(10.0, 2.0);
  elsewhere.target_pose.header.frame_id = "base_link";
  EXPECT_NE(abortReason(elsewhere).find("base_link"), std::string::npos);
  move_base_msgs::MoveBaseGoal no_rotation = goal(10.0, 2.0);
  no_rotation.target_pose.pose.orientation.w = 5.0;
  EXPECT_NE(abortReason(no_rotation).find("quaternion"), std::string::npos);
}

TEST_F(PlannerNode, PlansFromTheVesselToTheGoal) {
  client_.sendGoal(goal(22.0, 8.0));
  ASSERT_TRUE(trajectories_.waitFor([](const auto& message) { return !message.pieces.empty(); }));
  const auto timed =
      ros_bridge::toTrajectory(trajectories_.messages.back(), ros_bridge::frames().map);
  ASSERT_TRUE(timed.has_value()) << timed.error().message;
  const trajectory::Trajectory& trajectory = timed->trajectory;
  EXPECT_LT((trajectory.flat(0.0).position - kStart).norm(), 0.1);
  const Eigen::Vector2d end = trajectory.flat(trajectory.duration()).position;
  EXPECT_LT((end - Eigen::Vector2d(22.0, 8.0)).norm(), 0.1);
  EXPECT_TRUE(statuses_.waitFor([](const auto& status) {
    return status.outcome == "solved" && status.length > 40.0 && status.planning_ms > 0.0;
  }));
  expectRibbon(trajectory);
  client_.cancelGoal();
  ASSERT_TRUE(waitUntil([&] { return client_.getState().isDone(); }));
  EXPECT_EQ(client_.getState().toString(), "PREEMPTED");
}

// The vessel lies still whatever is ordered: what counts is what the node says and sends.
TEST_F(PlannerNode, FollowsTheOperator) {
  const auto wish = [](const std::string& name) {
    std_srvs::Trigger call;
    EXPECT_TRUE(ros_bridge::callService("planner_node/" + name, call)) << name;
    return call.response;
  };
  const auto comes = [this](const std::string& state) {
    statuses_.messages.clear();
    return statuses_.waitFor([&](const auto& status) { return status.state == state; });
  };
  EXPECT_TRUE(wish("stop").success);
  EXPECT_FALSE(wish("pause").success);
  EXPECT_NE(wish("pause").message.find("no mission"), std::string::npos);
  EXPECT_FALSE(wish("resume").success);

  EXPECT_TRUE(wish("hold").success);
  EXPECT_TRUE(comes(PlannerStatus::HOLDING));
  EXPECT_TRUE(trajectories_.waitFor([](const auto& message) { return message.pieces.empty(); }));
  EXPECT_TRUE(wish("resume").success);
  EXPECT_TRUE(comes(PlannerStatus::IDLE));

  client_.sendGoal(goal(22.0, 8.0));
  ASSERT_TRUE(comes(PlannerStatus::SAILING));
  EXPECT_GT(statuses_.messages.back().clearance, 0.5);
  EXPECT_TRUE(wish("pause").success);
  ASSERT_TRUE(comes(PlannerStatus::PAUSED));
  EXPECT_EQ(client_.getState(), State::ACTIVE);
  EXPECT_TRUE(wish("resume").success);
  ASSERT_TRUE(comes(PlannerStatus::SAILING));
  EXPECT_TRUE(wish("stop").success);
  ASSERT_TRUE(waitUntil([&] { return client_.getState().isDone(); }));
  EXPECT_EQ(client_.getState().toString(), "ABORTED");
  EXPECT_NE(client_.getState().getText().find("operator"), std::string::npos);
  EXPECT_TRUE(comes(PlannerStatus::IDLE));
}

TEST_F(PlannerNode, TakesGoalsFromRviz) {
  ros::Publisher simple = node_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
  ASSERT_TRUE(waitUntil([&] { return simple.getNumSubscribers() > 0; }));
  trajectories_.messages.clear();
  simple.publish(goal(-10.0, 10.0).target_pose);
  EXPECT_TRUE(trajectories_.waitFor([](const auto& message) {
    return !message.pieces.empty() && message.goal.position.x == -10.0;
  }));
}

// Else the vessel would lie, for the planner, where that says.
TEST_F(PlannerNode, GoesOnBehindOdometryStampedAhead) {
  const Eigen::Vector2d elsewhere(10.0, 10.0);
  odometry_.publish(odometryAt(elsewhere, 0.2, ros::Time::now() + ros::Duration(1000.0)));
  int told = 0;
  client_.sendGoal(goal(22.0, 8.0), Client::SimpleDoneCallback(), Client::SimpleActiveCallback(),
                   [&](const move_base_msgs::MoveBaseFeedbackConstPtr& feedback) {
                     const geometry_msgs::Point& p = feedback->base_position.pose.position;
                     EXPECT_LT(std::hypot(p.x - kStart.x(), p.y - kStart.y()), 0.1);
                     ++told;
                   });
  EXPECT_TRUE(waitUntil([&] { return told > 10; }));
  client_.cancelGoal();
  ASSERT_TRUE(waitUntil([&] { return client_.getState().isDone(); }));
}

// A node on this machine that neither answers nor dies, as one in a debugger does.
class Frozen {
 public:
  explicit Frozen(const std::string& node) {
    XmlRpc::XmlRpcValue asked;
    asked[0] = ros::this_node::getName();
    asked[1] = node;
    XmlRpc::XmlRpcValue answer;
    XmlRpc::XmlRpcValue uri;
    std::string host;
    std::uint32_t port = 0;
    if (!ros::master::execute("lookupNode", asked, answer, uri, false) ||
        !ros::network::splitURI(uri, host, port)) {
      return;
    }
    XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port));
    XmlRpc::XmlRpcValue self;
    self[0] = ros::this_node::getName();
    if (client.execute("getPid", self, answer) && !client.isFault()) {
      pid_ = answer[2];
      kill(pid_, SIGSTOP);
    }
  }
  ~Frozen() {
    if (pid_ > 0) {
      kill(pid_, SIGCONT);
    }
  }
  Frozen(const Frozen&) = delete;
  Frozen& operator=(const Frozen&) = delete;
  [[nodiscard]] bool found() const { return pid_ > 0; }

 private:
  int pid_ = 0;
};

TEST_F(PlannerNode, FindsItsOwnWayWhereNobodyAnswers) {
  const Frozen topology("/topology_node");
  ASSERT_TRUE(topology.found());
  for (const double y : {8.0, 4.0}) {
    trajectories_.messages.clear();
    client_.sendGoal(goal(22.0, y));
    EXPECT_TRUE(trajectories_.waitFor([&](const auto& message) {
      return !message.pieces.empty() && message.goal.position.y == y;
    }));
    client_.cancelGoal();
    ASSERT_TRUE(waitUntil([&] { return client_.getState().isDone(); }));
  }
}

// What is sailed goes on without this vessel; a tracker that is late on it, and knows, is not off
// it.
TEST_F(PlannerNode, IsAsFarOffAsTheTrackerSays) {
  const auto isFarOff = [](const PlannerStatus& status) {
    return status.reason.find("far off") != std::string::npos;
  };
  off_m_ = 0.05;
  client_.sendGoal(goal(22.0, 8.0));
  ASSERT_TRUE(
      statuses_.waitFor([](const auto& status) { return status.state == PlannerStatus::SAILING; }));
  const ros::Time sails = statuses_.messages.back().header.stamp;
  statuses_.messages.clear();
  ASSERT_TRUE(statuses_.waitFor([&](const auto& status) {
    return isFarOff(status) || status.header.stamp > sails + ros::Duration(4.0);
  }));
  EXPECT_TRUE(std::none_of(statuses_.messages.begin(), statuses_.messages.end(), isFarOff));
  off_m_ = 3.0;
  EXPECT_TRUE(statuses_.waitFor(isFarOff));
  client_.cancelGoal();
  ASSERT_TRUE(waitUntil([&] { return client_.getState().isDone(); }));
}

}  // namespace
}  // namespace otter_nav::rostest

OTTER_NAV_ROSTEST_MAIN("planner_node_test")
