// route_node against a stand-in of the action move_base: goals in order, changes on the way, and
// what a marker's menu sends.
#include <actionlib/server/simple_action_server.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseArray.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <otter_nav/Route.h>
#include <std_srvs/Trigger.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>
#include <visualization_msgs/InteractiveMarkerInit.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "support.hpp"

namespace otter_nav::rostest {
namespace {

class RouteNode : public testing::Test {
 protected:
  RouteNode() {
    server_.registerGoalCallback([this] { taken_.push_back(goalX()); });
    server_.registerPreemptCallback([this] {
      if (!server_.isNewGoalAvailable()) {
        server_.setPreempted({}, "cancelled");
      }
    });
    server_.start();
  }
  void SetUp() override {
    ASSERT_TRUE(waitUntil([&] {
      return set_.getNumSubscribers() > 0 && feedback_.getNumSubscribers() > 0 &&
             add_.getNumSubscribers() > 0;
    }));
    setGoals({});
    ASSERT_TRUE(routes_.waitFor([](const Route& route) { return route.goals.empty(); }));
    routes_.messages.clear();
  }

  double goalX() { return server_.acceptNewGoal()->target_pose.pose.position.x; }
  void setGoals(const std::vector<double>& x) {
    geometry_msgs::PoseArray goals;
    goals.header.frame_id = "map";
    for (const double each : x) {
      goals.poses.push_back(ros_bridge::toPose({{each, 0.0}, 0.0}));
    }
    set_.publish(goals);
  }
  bool routeHas(std::size_t goals, bool sailing, const std::string& reason = "") {
    return routes_.waitFor([&](const Route& route) {
      return route.goals.size() == goals && (route.sailing != 0) == sailing &&
             route.reason.find(reason) != std::string::npos;
    });
  }
  std_srvs::Trigger::Response ask(const std::string& name) {
    // The node's answer may need this one: the action's server lives here.
    std_srvs::Trigger call;
    EXPECT_TRUE(ros_bridge::callService("route_node/" + name, call));
    return call.response;
  }
  // Repeated until the action's client and server know each other.
  void sail() {
    ASSERT_TRUE(waitUntil([&] { return ask("sail").success != 0; }));
  }
  bool takes(const std::vector<double>& x) {
    return waitUntil([&] { return taken_ == x; });
  }
  void pickFromMenu(std::uint32_t entry, double x) {
    visualization_msgs::InteractiveMarkerFeedback feedback;
    feedback.header.frame_id = "map";
    feedback.client_id = "test";
    feedback.marker_name = "goal";
    feedback.event_type = visualization_msgs::InteractiveMarkerFeedback::MENU_SELECT;
    feedback.menu_entry_id = entry;
    feedback.pose = ros_bridge::toPose({{x, 2.0}, 0.7});
    feedback_.publish(feedback);
  }

  ros::NodeHandle node_;
  actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction> server_{node_, "move_base", false};
  std::vector<double> taken_;
  ros::Publisher set_ = node_.advertise<geometry_msgs::PoseArray>("route/set", 10);
  ros::Publisher add_ = node_.advertise<geometry_msgs::PoseStamped>("route/add", 10);
  ros::Publisher odometry_ = node_.advertise<nav_msgs::Odometry>("odom", 10);
  ros::Publisher feedback_ =
      node_.advertise<visualization_msgs::InteractiveMarkerFeedback>("goal_marker/feedback", 10);
  Inbox<Route> routes_{node_, "route"};
};

TEST_F(RouteNode, SailsGoalsInOrder) {
  EXPECT_EQ(ask("sail").message, "there are no goals to sail to");
  setGoals({1.0, 2.0});
  ASSERT_TRUE(routeHas(2, false));
  sail();
  ASSERT_TRUE(takes({1.0}));
  server_.setSucceeded();
  ASSERT_TRUE(takes({1.0, 2.0}));
  ASSERT_TRUE(routeHas(1, true));
  server_.setSucceeded();
  EXPECT_TRUE(routeHas(0, false, "all goals reached"));
}

TEST_F(RouteNode, KeepsTheGoalsLeftWhenOneFails) {
  setGoals({1.0, 2.0});
  ASSERT_TRUE(routeHas(2, false));
  sail();
  ASSERT_TRUE(takes({1.0}));
  server_.setAborted({}, "stopped by the operator");
  EXPECT_TRUE(routeHas(2, false, "stopped by the operator"));
  sail();
  EXPECT_TRUE(takes({1.0, 1.0}));
  server_.setAborted({}, "enough");
  EXPECT_TRUE(routeHas(2, false, "enough"));
}

TEST_F(RouteNode, ChangesOnTheWay) {
  setGoals({1.0, 2.0});
  ASSERT_TRUE(routeHas(2, false));
  sail();
  ASSERT_TRUE(takes({1.0}));
  // What comes later is changed without touching the goal under way.
  setGoals({1.0, 5.0, 6.0});
  ASSERT_TRUE(routeHas(3, true));
  EXPECT_TRUE(server_.isActive());
  EXPECT_EQ(taken_.size(), 1U);
  setGoals({5.0, 6.0});
  ASSERT_TRUE(takes({1.0, 5.0}));
  routes_.messages.clear();
  setGoals({});
  ASSERT_TRUE(routeHas(0, false));
  EXPECT_TRUE(waitUntil([&] { return !server_.isActive(); }));
}

TEST_F(RouteNode, RefusesGoalsThatMakeNoSense) {
  Inbox<diagnostic_msgs::DiagnosticArray> diagnostics{node_, "/diagnostics"};
  ASSERT_TRUE(diagnostics.connected());
  const auto tellsOf = [&](const std::string& topic) {
    return diagnostics.waitFor([&](const diagnostic_msgs::DiagnosticArray& message) {
      return std::any_of(message.status.begin(), message.status.end(), [&](const auto& status) {
        return status.level == diagnostic_msgs::DiagnosticStatus::WARN &&
               std::any_of(status.values.begin(), status.values.end(),
                           [&](const auto& value) { return value.key == "refused of " + topic; });
      });
    });
  };
  setGoals({1.0});
  ASSERT_TRUE(routeHas(1, false));
  routes_.messages.clear();
  setGoals({std::numeric_limits<double>::quiet_NaN()});
  geometry_msgs::PoseStamped elsewhere;
  elsewhere.header.frame_id = "odom";
  elsewhere.pose = ros_bridge::toPose({{3.0, 0.0}, 0.0});
  add_.publish(elsewhere);
  elsewhere.header.frame_id = "map";
  add_.publish(elsewhere);
  ASSERT_TRUE(routeHas(2, false));
  EXPECT_EQ(routes_.messages.size(), 1U);
  EXPECT_TRUE(tellsOf("route/set"));
  EXPECT_TRUE(tellsOf("route/add"));
}

TEST_F(RouteNode, TakesGoalsFromTheMarker) {
  // The marker comes up ahead of the vessel.
  Inbox<visualization_msgs::InteractiveMarkerInit> markers(node_, "goal_marker/update_full");
  ASSERT_TRUE(waitUntil([&] {
    odometry_.publish(odometryAt({4.0, 0.0}, 0.0, ros::Time::now()));
    return !markers.messages.empty() && !markers.messages.back().markers.empty();
  }));
  EXPECT_NEAR(markers.messages.back().markers.front().pose.position.x, 14.0, 1e-9);

  ASSERT_EQ(ask("add_marker").success, 1);
  ASSERT_TRUE(routeHas(1, false));
  pickFromMenu(2, 30.0);
  ASSERT_TRUE(routeHas(2, false));
  EXPECT_EQ(routes_.messages.back().goals.back().position.x, 30.0);
  EXPECT_NEAR(routes_.messages.back().goals.back().orientation.z, std::sin(0.35), 1e-9);
  setGoals({1.0});
  sail();
  ASSERT_TRUE(takes({1.0}));
  pickFromMenu(1, 40.0);
  EXPECT_TRUE(takes({1.0, 40.0}));
  EXPECT_TRUE(routeHas(1, true));
}

}  // namespace
}  // namespace otter_nav::rostest

OTTER_NAV_ROSTEST_MAIN("route_node_test")
