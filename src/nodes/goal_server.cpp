#include "goal_server.hpp"

#include <ros/console.h>

#include <utility>

#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/frames.hpp"

namespace otter_nav::nodes {
namespace {

using Outcome = move_base_msgs::MoveBaseResult;

}  // namespace

GoalServer::GoalServer(ros::NodeHandle& node, OnGoal on_goal, OnCancel on_cancel)
    : on_goal_(std::move(on_goal)),
      on_cancel_(std::move(on_cancel)),
      action_goal_(node.advertise<move_base_msgs::MoveBaseActionGoal>("move_base/goal", 1)),
      server_(
          node, "move_base", [this](const Handle& handle) { onActionGoal(handle); },
          [this](const Handle& handle) { onActionCancel(handle); }, false) {
  // rviz's goal takes the way of the action, so that there is one way only.
  simple_goal_ = node.subscribe<geometry_msgs::PoseStamped>(
      "move_base_simple/goal", 1, [this](const geometry_msgs::PoseStampedConstPtr& goal) {
        move_base_msgs::MoveBaseActionGoal message;
        message.header.stamp = ros::Time::now();
        message.goal.target_pose = *goal;
        action_goal_.publish(message);
      });
  server_.start();
}

void GoalServer::onActionGoal(const Handle& handle) {
  if (!ready_) {
    if (!waiting_) {
      waiting_since_ = ros::WallTime::now();
    }
    (void)abortWaiting(kReplaced);
    waiting_ = handle;
    return;
  }
  take(handle);
}

void GoalServer::retryWaiting() {
  if (ready_ && waiting_) {
    const Handle handle = *std::exchange(waiting_, std::nullopt);
    take(handle);
  }
}

bool GoalServer::abortWaiting(const std::string& reason) {
  if (!waiting_) {
    return false;
  }
  ROS_WARN_STREAM("Dropped the goal that waited: " << reason);
  waiting_->setRejected(Outcome(), reason);
  waiting_.reset();
  return true;
}

std::optional<ros::WallDuration> GoalServer::waiting() const {
  return waiting_ ? std::optional(ros::WallTime::now() - waiting_since_) : std::nullopt;
}

void GoalServer::take(Handle handle) {
  handle.setAccepted();
  const Status taken =
      ros_bridge::planarPose(handle.getGoal()->target_pose, ros_bridge::frames().map)
          .and_then([&](const vessel::Pose& pose) { return on_goal_(pose); });
  if (!taken) {
    ROS_WARN_STREAM("Refused the goal: " << taken.error().message);
    handle.setAborted(Outcome(), taken.error().message);
    return;
  }
  if (under_way_) {
    under_way_->setCanceled(Outcome(), kReplaced);
  }
  under_way_ = handle;
}

void GoalServer::onActionCancel(const Handle& handle) {
  if (waiting_ && *waiting_ == handle) {
    waiting_->setCanceled(Outcome(), "cancelled");
    waiting_.reset();
  }
  if (under_way_ && *under_way_ == handle) {
    under_way_->setCanceled(Outcome(), "cancelled");
    under_way_.reset();
    on_cancel_();
  }
}

void GoalServer::succeed(const std::string& text) {
  if (under_way_) {
    under_way_->setSucceeded(Outcome(), text);
    under_way_.reset();
  }
}

void GoalServer::abort(const std::string& reason) {
  if (under_way_) {
    under_way_->setAborted(Outcome(), reason);
    under_way_.reset();
  }
}

void GoalServer::feedback(const vessel::Pose& pose, const ros::Time& stamp) {
  if (under_way_) {
    move_base_msgs::MoveBaseFeedback message;
    message.base_position = ros_bridge::toPose(pose, ros_bridge::frames().map, stamp);
    under_way_->publishFeedback(message);
  }
}

}  // namespace otter_nav::nodes
