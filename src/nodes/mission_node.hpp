// mission_node: sails one mission of a scenario. Sends the goal once everybody is there, watches
// the truth, shows the progress, writes result and track, and ends. Parameters:
// config/mission_node.yaml.
#pragma once

#include <actionlib/client/simple_action_client.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <otter_nav/PlannerStatus.h>
#include <otter_nav/PlantState.h>
#include <otter_nav/TrackerStatus.h>
#include <otter_nav/Trajectory.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>

#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "mission_node_options.hpp"
#include "otter_nav/base/progress_line.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/scenario/recorder.hpp"
#include "otter_nav/scenario/report.hpp"
#include "otter_nav/scenario/scenario.hpp"
#include "reference_log.hpp"

namespace otter_nav::nodes {

class MissionNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<MissionNode>> create(config::Section section);
  ~MissionNode();
  MissionNode(const MissionNode&) = delete;
  MissionNode& operator=(const MissionNode&) = delete;
  // 0 only if the vessel arrived.
  [[nodiscard]] int exitCode() const { return exit_code_; }

 private:
  MissionNode(MissionNodeOptions options, const scenario::Scenario& scenario,
              const scenario::Mission& mission, const vessel::Parameters& vessel,
              std::optional<scenario::TrackWriter> track);

  void onRecording(const std_msgs::Header& message);
  void onState(const PlantState& message);
  void onTrajectory(const Trajectory& message);
  void onPlannerStatus(const PlannerStatus& message);
  void onGoalDone(const actionlib::SimpleClientGoalState& state);
  void onTimer();
  [[nodiscard]] Status limitSpeed();
  void sendGoal();
  // Time may go on: the first plan stands, or there will be none.
  void openGate();
  void goOn();
  [[nodiscard]] bool over() const;
  // The motion up to a time at which all that was decided is known here.
  void recordUntil(double time_s);
  void record(const PlantState& state);
  void judge();
  void show(const PlantState& state);
  [[nodiscard]] std::string missWhenArrived() const;
  void finish(scenario::Outcome outcome, const std::string& reason);

  MissionNodeOptions options_;
  scenario::MissionLabel label_;
  scenario::Mission mission_;
  ros::NodeHandle node_;
  ReferenceLog references_;
  scenario::Recorder recorder_;
  ProgressLine progress_;
  std::optional<scenario::TrackWriter> track_;
  std::deque<PlantState> states_;  // not recorded yet
  std::optional<PlantState> last_state_;
  double first_time_s_ = -1.0;
  double last_state_time_s_ = -1.0;
  double next_track_s_ = 0.0;
  PlannerStatus planner_;
  TrackerStatus tracker_;
  bool recorded_ = false;  // or need not be
  bool goal_sent_ = false;
  bool gate_open_ = false;
  bool finished_ = false;
  bool sails_on_ = false;  // to another goal
  int exit_code_ = 1;
  ros::WallTime last_sign_;
  ros::WallTime last_shown_;

  actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction> action_{"move_base", false};
  ros::Publisher acknowledgement_;
  ros::Subscriber state_subscriber_;
  ros::Subscriber trajectory_subscriber_;
  ros::Subscriber planner_subscriber_;
  ros::Subscriber tracker_subscriber_;
  ros::Subscriber recording_subscriber_;
  ros::WallTimer timer_;
};

}  // namespace otter_nav::nodes
