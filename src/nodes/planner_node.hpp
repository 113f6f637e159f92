// planner_node: takes goals, plans, watches the way and plans anew when it must. The decisions are
// mission::Supervisor's; this wires them. Parameters: config/planner_node.yaml, and the rooms' own
// under ~planner (config/planner.yaml) and ~supervisor (config/mission.yaml).
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <otter_nav/TrackerStatus.h>
#include <otter_nav/Tracks.h>
#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "goal_server.hpp"
#include "odometry_history.hpp"
#include "otter_nav/config/field_list.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/ros/map_mirror.hpp"
#include "plan_worker.hpp"
#include "planner_node_options.hpp"
#include "planner_publisher.hpp"
#include "tracker_watch.hpp"

namespace otter_nav::nodes {

class PlannerNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<PlannerNode>> create(config::Section section);
  [[nodiscard]] static int exitCode() { return 0; }
  // What may change while it runs.
  [[nodiscard]] std::vector<config::NumberField> live() const;
  [[nodiscard]] Status change(config::Section section);

 private:
  struct Setup {
    PlannerNodeOptions node;
    vessel::Parameters vessel;
    mission::SupervisorOptions supervisor;
    planner::Options planner;
  };
  [[nodiscard]] static Result<Setup> readSetup(config::Section section);
  explicit PlannerNode(const Setup& setup);

  void onMap(const nav_msgs::OccupancyGrid& message);
  void onUpdate(const map_msgs::OccupancyGridUpdateConstPtr& message);
  void onOdometry(const nav_msgs::Odometry& message);
  void onTrackerStatus(const TrackerStatus& message);
  void onTracks(const Tracks& message);
  [[nodiscard]] Status onGoal(const vessel::Pose& goal);
  void onCancel();
  // The operator's wishes (docs/nodes.md). The answer says why one can't be followed.
  void serve(const std::string& name, Result<mission::Orders> (PlannerNode::*wish)());
  [[nodiscard]] Result<mission::Orders> pause();
  [[nodiscard]] Result<mission::Orders> hold();
  [[nodiscard]] Result<mission::Orders> resume();
  [[nodiscard]] Result<mission::Orders> stop();
  void onPlanDone(const mission::PlanRequest& request, const planner::Plan& plan, double wall_ms);

  // Lockstep: map updates in turn, each with the odometry of its stamp, none while an order of the
  // one before is still under way.
  void decideInTurn();
  void decide();
  void execute(const mission::Orders& orders);
  // What follows from the supervisor's phase: results of the goal, status, acknowledgement.
  void settle();
  void checkInputs();
  [[nodiscard]] mission::Situation situation() const;
  [[nodiscard]] feasibility::Obstacles obstacles() const;

  Setup setup_;
  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  ros_bridge::MapMirror map_;
  OdometryHistory odometry_;
  TrackerWatch tracker_;
  std::vector<traffic::Track> tracks_;  // other vessels, as last told
  double tracks_stamp_s_ = 0.0;
  mission::Supervisor supervisor_;
  PlannerPublisher publisher_;
  mission::Phase shown_ = mission::Phase::kIdle;  // by its markers

  double now_s_ = 0.0;                                         // of the decision under way
  ros_bridge::OdometrySample vessel_;                          // at that decision
  std::deque<map_msgs::OccupancyGridUpdateConstPtr> updates_;  // waiting for their turn
  std::optional<ros::Time> unacknowledged_;
  ros::Time acknowledged_;
  int plan_under_way_ = 0;          // id of the request; 0 for none
  std::uint32_t sent_id_ = 0;       // of the last trajectory published
  std::uint32_t confirmed_id_ = 0;  // of the last the tracker has
  ros::WallTime waiting_since_;

  ros::Publisher acknowledgement_;
  ros::Subscriber map_subscriber_;
  ros::Subscriber update_subscriber_;
  ros::Subscriber odometry_subscriber_;
  ros::Subscriber tracker_subscriber_;
  ros::Subscriber tracks_subscriber_;
  std::vector<ros::ServiceServer> wishes_;
  ros::WallTimer decision_timer_;
  ros::WallTimer input_timer_;
  GoalServer goals_;
  PlanWorker worker_;
};

}  // namespace otter_nav::nodes
