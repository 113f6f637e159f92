// Goals from the action `move_base` and from `move_base_simple/goal`, and what becomes of them.
#pragma once

#include <actionlib/server/action_server.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::nodes {

// What the client of a goal is told when another one takes its place.
inline constexpr char kReplaced[] = "replaced by another goal";

// One goal at a time is under way; an accepted goal replaces the one before it, a refused one
// leaves it be. Callbacks come in the node's thread.
class GoalServer {
 public:
  // Takes the goal, or says why not.
  using OnGoal = std::function<Status(const vessel::Pose&)>;
  using OnCancel = std::function<void()>;

  GoalServer(ros::NodeHandle& node, OnGoal on_goal, OnCancel on_cancel);

  void succeed(const std::string& text);
  void abort(const std::string& reason);
  void feedback(const vessel::Pose& pose, const ros::Time& stamp);
  // Looks again at a goal that came before the node was ready for it.
  void retryWaiting();
  // A goal that comes now waits until retryWaiting().
  void setReady(bool ready) { ready_ = ready; }
  // The goal that waits is aborted; false if none does.
  bool abortWaiting(const std::string& reason);
  // Wall time for which a goal has been waiting; none waits: nothing.
  [[nodiscard]] std::optional<ros::WallDuration> waiting() const;

 private:
  using Server = actionlib::ActionServer<move_base_msgs::MoveBaseAction>;
  using Handle = Server::GoalHandle;

  void onActionGoal(const Handle& handle);
  void onActionCancel(const Handle& handle);
  void take(Handle handle);

  OnGoal on_goal_;
  OnCancel on_cancel_;
  bool ready_ = false;
  std::optional<Handle> under_way_;
  std::optional<Handle> waiting_;
  ros::WallTime waiting_since_;  // the first of those that waited
  ros::Publisher action_goal_;
  ros::Subscriber simple_goal_;
  Server server_;
};

}  // namespace otter_nav::nodes
