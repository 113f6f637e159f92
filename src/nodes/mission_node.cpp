// mission_node: sails one mission of a scenario. Sends the goal once everybody is there, watches
// the truth, shows the progress, writes result and track, and ends. Parameters:
// config/mission_node.yaml.
#include <actionlib/client/simple_action_client.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <otter_nav/PlannerStatus.h>
#include <otter_nav/PlantState.h>
#include <otter_nav/TrackerStatus.h>
#include <otter_nav/Trajectory.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include "goal_server.hpp"
#include "mission_node_options.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/base/progress_line.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/plant/signals.hpp"
#include "otter_nav/ros/call_service.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/parameters.hpp"
#include "otter_nav/ros/run_node.hpp"
#include "otter_nav/ros/trajectories.hpp"
#include "otter_nav/scenario/recorder.hpp"
#include "otter_nav/scenario/report.hpp"
#include "otter_nav/scenario/scenario.hpp"
#include "reference_log.hpp"

namespace otter_nav::nodes {
namespace {

using scenario::Outcome;

constexpr int kQueue = 1000;
constexpr double kTimerPeriodS = 0.1;
constexpr double kSilenceS = 60.0;    // of wall time without news of the plant: an error
constexpr double kAbortedS = 2.0;     // of wall time in which the planner's status says why
constexpr double kShowPeriodS = 0.2;  // of wall time
constexpr double kTrackPeriodS = 0.05;
// Where no planner_node has tolerances of its own.
constexpr double kArrivalDistanceM = 0.9;
constexpr double kArrivalHeadingRad = 0.15;
// Of the true pose, beyond what the planner asks for by its odometry.
constexpr double kArrivalSlackM = 0.1;
constexpr double kArrivalSlackRad = 0.025;
constexpr char kPlannerOptions[] = "planner_node/supervisor/";
constexpr char kPlannerService[] = "planner_node/set_parameters";

// Whether roslaunch started this process: it is asked to end the launch, as by Ctrl-C.
bool isUnderRoslaunch() {
  std::ifstream file("/proc/" + std::to_string(getppid()) + "/cmdline");
  const std::string command(std::istreambuf_iterator<char>(file), {});
  return command.find("roslaunch") != std::string::npos;
}

vessel::State stateOf(const PlantState& message) {
  vessel::State state;
  state << message.x, message.y, message.yaw, message.u, message.v, message.r;
  return state;
}

// The track lies beside the result.
std::string trackPath(const std::string& result) {
  return std::filesystem::path(result).replace_extension(".csv").string();
}

}  // namespace

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
              std::optional<scenario::TableWriter> track);

  void onRecording(const std_msgs::Header& message);
  void onState(const PlantState& message);
  void onTrajectory(const Trajectory& message);
  void onPlannerStatus(const PlannerStatus& message);
  void onGoalTaken();
  void onGoalDone(const actionlib::SimpleClientGoalState& state);
  void onTimer();
  [[nodiscard]] Status limitSpeed();
  void sendGoal();
  // Time may go on: the first plan stands, or there will be none.
  void openGate();
  void goOn();
  // The planner's status and the action's result both say so: a status alone may be of the goal
  // before.
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
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  ReferenceLog references_;
  std::uint32_t newest_trajectory_ = 0;
  scenario::Recorder recorder_;
  ProgressLine progress_;
  std::optional<scenario::TableWriter> track_;
  std::deque<PlantState> states_;  // not recorded yet
  std::optional<PlantState> last_state_;
  double first_time_s_ = -1.0;
  double last_state_time_s_ = -1.0;
  double next_track_s_ = 0.0;
  PlannerStatus planner_;
  TrackerStatus tracker_;
  bool recorded_ = false;  // or need not be
  bool goal_sent_ = false;
  bool goal_taken_ = false;
  std::optional<actionlib::SimpleClientGoalState> goal_done_;
  ros::WallTime goal_done_at_;
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

Result<std::unique_ptr<MissionNode>> MissionNode::create(config::Section section) {
  const std::string where = section.where();
  Result<MissionNodeOptions> options = config::read<MissionNodeOptions>(std::move(section));
  if (!options) {
    return failure(options.error().message);
  }
  const auto scenario = scenario::loadScenario(options->scenario);
  const auto mission = scenario.and_then(
      [&](const scenario::Scenario& all) { return scenario::missionOf(all, options->mission); });
  const auto vessel = vessel::loadParameters(options->vessel);
  if (const Status status = firstFailure(mission, vessel); !status) {
    return failure(status.error().message);
  }
  std::optional<scenario::TableWriter> track;
  if (!options->result.empty()) {
    if (trackPath(options->result) == options->result) {
      return failure(where + ": parameter 'result' = '" + options->result +
                     "' is where its track will be written: give a file that doesn't end in .csv");
    }
    if (std::error_code none; std::filesystem::is_directory(options->result, none)) {
      return failure(where + ": parameter 'result' = '" + options->result + "' is a folder");
    }
    Result<scenario::TableWriter> opened =
        scenario::TableWriter::open(trackPath(options->result), scenario::kTrackColumns);
    if (!opened) {
      return failure(opened.error().message);
    }
    track.emplace(std::move(*opened));
  }
  return std::unique_ptr<MissionNode>(
      new MissionNode(*std::move(options), *scenario, *mission, *vessel, std::move(track)));
}

MissionNode::MissionNode(MissionNodeOptions options, const scenario::Scenario& scenario,
                         const scenario::Mission& mission, const vessel::Parameters& vessel,
                         std::optional<scenario::TableWriter> track)
    : options_(std::move(options)),
      label_{scenario.name, options_.mission, options_.vessel, options_.disturbance,
             static_cast<std::uint64_t>(options_.seed)},
      mission_(mission),
      diagnostics_(node_, private_node_, vessel.name),
      references_(vessel),
      progress_(std::cout, isatty(STDOUT_FILENO) != 0),
      track_(std::move(track)),
      recorded_(!options_.recorded),
      last_sign_(ros::WallTime::now()),
      acknowledgement_(node_.advertise<std_msgs::Header>("lockstep_ack", 1, true)) {
  const ros::TransportHints no_delay = ros::TransportHints().tcpNoDelay();
  state_subscriber_ = node_.subscribe("plant_state", kQueue, &MissionNode::onState, this, no_delay);
  trajectory_subscriber_ =
      node_.subscribe("trajectory", kQueue, &MissionNode::onTrajectory, this, no_delay);
  planner_subscriber_ =
      node_.subscribe("planner_status", kQueue, &MissionNode::onPlannerStatus, this, no_delay);
  tracker_subscriber_ = node_.subscribe<TrackerStatus>(
      "tracker_status", kQueue,
      [this](const TrackerStatusConstPtr& message) { tracker_ = *message; });
  recording_subscriber_ = node_.subscribe("recording", 1, &MissionNode::onRecording, this);
  timer_ = node_.createWallTimer(ros::WallDuration(kTimerPeriodS),
                                 [this](const ros::WallTimerEvent&) { onTimer(); });
}

MissionNode::~MissionNode() {
  finish(Outcome::kError, "interrupted before the end");
}

void MissionNode::onRecording(const std_msgs::Header& /*message*/) {
  recorded_ = true;
}

void MissionNode::onState(const PlantState& message) {
  if (message.header.stamp.toSec() > last_state_time_s_) {
    states_.push_back(message);
    last_state_time_s_ = message.header.stamp.toSec();
    last_sign_ = ros::WallTime::now();
    goOn();
  }
}

// One that can't be taken is waited for no longer than one that can: the tracker refuses it too.
void MissionNode::onTrajectory(const Trajectory& message) {
  newest_trajectory_ = std::max(newest_trajectory_, message.id);
  Result<trajectory::TimedTrajectory> timed =
      ros_bridge::toTrajectory(message, ros_bridge::frames().map);
  if (!timed) {
    diagnostics_.refuse("trajectory", timed.error().message);
    return;
  }
  references_.add(message.id, std::move(*timed));
}

void MissionNode::onPlannerStatus(const PlannerStatus& message) {
  const bool ended =
      planner_.state == PlannerStatus::ARRIVED || planner_.state == PlannerStatus::FAILED;
  if (goal_taken_ && (over() || (ended && message.state == planner_.state))) {
    return;  // the first that tells of the end counts
  }
  planner_ = message;
  onGoalTaken();
}

bool MissionNode::over() const {
  using State = actionlib::SimpleClientGoalState;
  return goal_done_ &&
         ((planner_.state == PlannerStatus::ARRIVED && *goal_done_ == State::SUCCEEDED) ||
          (planner_.state == PlannerStatus::FAILED && *goal_done_ == State::ABORTED));
}

// Goes on to the planner's last decision, once the trajectory it speaks of is known here; to the
// mission's end only with the whole motion up to it.
void MissionNode::goOn() {
  if (!gate_open_ || finished_ || newest_trajectory_ < planner_.trajectory_id) {
    return;
  }
  const double decided_s = planner_.header.stamp.toSec();
  recordUntil(decided_s);
  if (!over() || last_state_time_s_ >= decided_s) {
    judge();
  }
}

void MissionNode::onTimer() {
  if (!goal_sent_ && recorded_ && action_.isServerConnected() && !states_.empty()) {
    sendGoal();
  }
  using State = actionlib::SimpleClientGoalState;
  // By the operator, or as the clock was set back; not before the vessel has come to rest.
  if (goal_done_ && *goal_done_ == State::ABORTED && !over() &&
      planner_.state != PlannerStatus::STOPPING &&
      (ros::WallTime::now() - goal_done_at_).toSec() > kAbortedS) {
    finish(Outcome::kStopped, goal_done_->getText());
  }
  const double silent_s = (ros::WallTime::now() - last_sign_).toSec();
  if (silent_s > kSilenceS) {
    finish(Outcome::kError, goal_sent_  ? "the plant fell silent while " + planner_.state
                            : recorded_ ? "the plant or the planner did not come up"
                                        : "the recorder did not come up");
  }
}

// Before the goal, so that it holds for the first plan already.
Status MissionNode::limitSpeed() {
  if (!mission_.speed_mps) {
    return {};
  }
  dynamic_reconfigure::Reconfigure call;
  call.request.config.doubles.resize(1);
  call.request.config.doubles[0].name = "speed_max_mps";
  call.request.config.doubles[0].value = *mission_.speed_mps;
  const std::string why = "the mission's speed limit can't be set";
  constexpr double kPatienceS = 5.0;  // of wall time
  if (!ros::service::waitForService(kPlannerService, ros::Duration(kPatienceS)) ||
      !ros_bridge::callService(kPlannerService, call)) {
    return failure(why + ": no answer from " + kPlannerService);
  }
  for (const auto& number : call.response.config.doubles) {
    if (number.name == "speed_max_mps" && number.value == *mission_.speed_mps) {
      return {};
    }
  }
  return failure(why + ": the planner refuses " + std::to_string(*mission_.speed_mps) + " m/s");
}

void MissionNode::sendGoal() {
  goal_sent_ = true;
  if (const Status status = limitSpeed(); !status) {
    finish(Outcome::kError, status.error().message);
    return;
  }
  move_base_msgs::MoveBaseGoal goal;
  goal.target_pose =
      ros_bridge::toPose(mission_.goal, ros_bridge::frames().map, states_.front().header.stamp);
  action_.sendGoal(
      goal,
      [this](const actionlib::SimpleClientGoalState& state,
             const move_base_msgs::MoveBaseResultConstPtr&) { onGoalDone(state); },
      [this] {
        goal_taken_ = true;
        onGoalTaken();
      });
}

void MissionNode::onGoalTaken() {
  if (goal_taken_ && planner_.state != PlannerStatus::IDLE) {
    openGate();
    goOn();
  }
}

// The planner's status tells of arrival and failure; what is left is a goal it never took on, or
// dropped for another. The vessel is somebody else's then: this node stays, lest the launch ends.
void MissionNode::onGoalDone(const actionlib::SimpleClientGoalState& state) {
  goal_done_ = state;
  goal_done_at_ = ros::WallTime::now();
  if (over()) {
    openGate();
    goOn();
  } else if (state.getText() == kReplaced) {
    openGate();
    sails_on_ = true;
    finish(Outcome::kStopped, "another goal was sent: this mission ends here, the vessel sails on");
  } else if (!gate_open_) {
    finish(Outcome::kError, state.getText());
  } else if (state != actionlib::SimpleClientGoalState::SUCCEEDED &&
             state != actionlib::SimpleClientGoalState::ABORTED) {
    finish(Outcome::kError, "the goal was " + state.toString() + ": " + state.getText());
  }
}

void MissionNode::openGate() {
  if (gate_open_) {
    return;
  }
  gate_open_ = true;
  std_msgs::Header acknowledgement;
  acknowledgement.stamp = ros::TIME_MAX;
  acknowledgement.frame_id = ros_bridge::nodeName();
  acknowledgement_.publish(acknowledgement);
}

void MissionNode::recordUntil(double time_s) {
  while (!finished_ && !states_.empty() && states_.front().header.stamp.toSec() <= time_s) {
    last_state_ = states_.front();
    states_.pop_front();
    record(*last_state_);
    if (last_state_->in_contact != 0) {
      finish(Outcome::kCollided, "the hull touched something while " + planner_.state);
    } else if (plant::capsized(last_state_->roll, last_state_->pitch)) {
      finish(Outcome::kCapsized, "turned over by waves and thrust while " + planner_.state);
    }
  }
  if (last_state_ && !finished_) {
    show(*last_state_);
  }
}

void MissionNode::record(const PlantState& state) {
  const double time_s = state.header.stamp.toSec();
  if (first_time_s_ < 0.0) {
    first_time_s_ = time_s;
  }
  scenario::MotionSample sample;
  sample.t_s = time_s - first_time_s_;
  sample.state = stateOf(state);
  sample.roll_rad = state.roll;
  sample.pitch_rad = state.pitch;
  sample.thrusts_n = {state.thrust_left, state.thrust_right};
  sample.reference = references_.pose(time_s);
  sample.clearance_m = state.clearance;
  recorder_.addMotion(sample);
  constexpr double kRounding = 1e-6;
  if (track_ && sample.t_s >= next_track_s_ - kRounding) {
    track_->write(scenario::trackRow(sample));
    next_track_s_ += kTrackPeriodS;
  }
}

void MissionNode::judge() {
  if (finished_ || !last_state_) {
    return;
  }
  const double time_s = last_state_->header.stamp.toSec() - first_time_s_;
  if (over() && planner_.state == PlannerStatus::ARRIVED) {
    const std::string miss = missWhenArrived();
    finish(miss.empty() ? Outcome::kArrived : Outcome::kStopped,
           miss.empty() ? planner_.reason : miss);
  } else if (over()) {
    finish(Outcome::kStopped, planner_.reason);
  } else if (time_s > options_.timeout_s) {
    finish(Outcome::kTimeout, planner_.state + ": " + planner_.reason);
  }
}

std::string MissionNode::missWhenArrived() const {
  const vessel::State state = stateOf(*last_state_);
  const auto tolerance = [](const char* key, double otherwise) {
    return ros::param::param(std::string(kPlannerOptions) + key, otherwise);
  };
  const double most_m = kArrivalSlackM + tolerance("arrival_distance_m", kArrivalDistanceM);
  const double most_rad = kArrivalSlackRad + tolerance("arrival_heading_rad", kArrivalHeadingRad);
  const double distance_m = (state.head<2>() - mission_.goal.position).norm();
  const double heading_rad = std::abs(wrapAngle(state[vessel::kPsi] - mission_.goal.psi_rad));
  // An arrival with a reason is one on another heading: the goal's can't be held.
  if (distance_m <= most_m && (heading_rad <= most_rad || !planner_.reason.empty())) {
    return {};
  }
  return "the planner takes the goal for reached, " + std::to_string(distance_m) + " m and " +
         std::to_string(heading_rad) + " rad off";
}

void MissionNode::show(const PlantState& state) {
  if ((ros::WallTime::now() - last_shown_).toSec() < kShowPeriodS) {
    return;
  }
  last_shown_ = ros::WallTime::now();
  const double time_s = state.header.stamp.toSec();
  const Eigen::Vector2d position(state.x, state.y);
  const auto reference = references_.pose(time_s);
  scenario::Progress progress;
  progress.t_s = time_s - first_time_s_;
  progress.distance_left_m =
      references_.distanceLeft(time_s).value_or((mission_.goal.position - position).norm());
  progress.speed_mps = std::hypot(state.u, state.v);
  progress.clearance_m = state.clearance;
  progress.tracking_error_m = reference ? (reference->head<2>() - position).norm() : 0.0;
  progress.state = planner_.state;
  progress.detail = planner_.reason;
  progress_.show(scenario::progressText(progress), progress.state, progress.t_s);
  diagnostics_.setState(ros_bridge::Diagnostics::Level::kOk, progress.state);
}

void MissionNode::finish(Outcome outcome, const std::string& reason) {
  if (finished_) {
    return;
  }
  finished_ = true;
  progress_.finish();
  scenario::MissionResult result =
      recorder_.result(label_, outcome, reason, static_cast<int>(planner_.replans));
  result.replans_for_weather = static_cast<int>(planner_.replans_for_weather);
  result.planning_ms_median = planner_.planning_ms_median;
  result.planning_ms_max = planner_.planning_ms_max;
  result.tracker_ms_p99 = tracker_.solver_ms_p99;
  Status track;
  if (track_) {
    result.track = trackPath(options_.result);
    track = track_->close();
  }
  Status saved = options_.result.empty() ? Status() : scenario::saveJson(options_.result, {result});
  for (const Status* status : {&track, &saved}) {
    if (!*status) {
      std::cerr << status->error().message << '\n';
    }
  }
  std::cout << scenario::summaryText(result) << std::flush;
  exit_code_ = outcome == Outcome::kArrived && track && saved ? 0 : 1;
  state_subscriber_.shutdown();
  trajectory_subscriber_.shutdown();
  if (sails_on_) {
    return;
  }
  if (isUnderRoslaunch()) {
    kill(getppid(), SIGINT);  // which ends this node too
  } else {
    ros::requestShutdown();
  }
}

}  // namespace otter_nav::nodes

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::MissionNode>(argc, argv, "mission_node");
}
