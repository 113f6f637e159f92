// tracker_node: keeps the vessel on the planner's trajectory. Parameters:
// config/tracker_node.yaml, the tracker's own under ~tracker (config/tracker.yaml).
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <otter_nav/NearObstacles.h>
#include <otter_nav/ThrusterCommand.h>
#include <otter_nav/TrackerCycle.h>
#include <otter_nav/TrackerStatus.h>
#include <otter_nav/Trajectory.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "control_loop.hpp"
#include "cycle_statistics.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/config/field_list.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/near_obstacles.hpp"
#include "otter_nav/ros/run_node.hpp"
#include "otter_nav/ros/trajectories.hpp"
#include "stamps.hpp"
#include "tracker_node_options.hpp"

namespace otter_nav::nodes {
namespace {

using ros_bridge::frames;
using Level = ros_bridge::Diagnostics::Level;

constexpr int kQueue = 100;
constexpr int kPredictionInterval = 10;  // steps
constexpr double kStatusRateHz = 10.0;   // of simulated time
constexpr double kOdometryLateS = 5.0;
constexpr double kLockstepStatusPeriodS = 1.0 / kStatusRateHz;

Level levelOf(const tracker::Command& command) {
  if (command.mode == tracker::Mode::kFault) {
    return Level::kError;
  }
  return command.reason.empty() ? Level::kOk : Level::kWarning;
}

struct Setup {
  TrackerNodeOptions node;
  tracker::Options tracker;
};

Result<Setup> readSetup(config::Section section) {
  Setup setup;
  const Status node = config::readFields(section, setup.node);
  const auto tracker = config::read<tracker::Options>(section.child("tracker"));
  if (const Status status = firstFailure(node, section.finish(), tracker); !status) {
    return failure(status.error().message);
  }
  if (!setup.node.lockstep && setup.node.speed <= 0.0) {
    return failure(section.where() +
                   ": parameter 'speed' = 0 is outside its allowed range (0, 1000] when 'lockstep' "
                   "is false");
  }
  setup.tracker = *tracker;
  return setup;
}

}  // namespace

class TrackerNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<TrackerNode>> create(config::Section section);
  [[nodiscard]] static int exitCode() { return 0; }

  // What may change while it runs.
  [[nodiscard]] std::vector<config::NumberField> live() const;
  [[nodiscard]] Status change(config::Section section);

 private:
  TrackerNode(TrackerNodeOptions options, const tracker::Options& tracker,
              const vessel::Parameters& vessel);

  void onTrajectory(const Trajectory& message);
  void onNearObstacles(const NearObstacles& message);
  void onOdometry(const nav_msgs::Odometry& message);
  void begin();
  // Lockstep: the command for the odometry's stamp.
  void controlStep(const ros::Time& stamp);
  // How late a step that began `now` is on the beat of simulated time.
  [[nodiscard]] double latenessMs(const ros::WallTime& now);
  void publish(const ControlOutput& output);
  void publishCycle(const tracker::Command& command);
  void publishPrediction(const tracker::Prediction& prediction);
  void publishStatus();
  [[nodiscard]] TrackerStatus status() const;
  // For long; in lockstep time stands still without.
  [[nodiscard]] bool lacksOdometry() const;

  TrackerNodeOptions options_;
  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  std::unique_ptr<tracker::Tracker> tracker_;
  double period_s_;
  CycleStatistics statistics_;

  // What the status tells; `mutex_` guards it, the control loop stays away from it.
  mutable std::mutex mutex_;
  tracker::Command last_command_;
  double told_s_ = -1.0;  // its time
  tracker::Prediction last_prediction_;
  ThrusterCommand command_message_;
  TrackerCycle cycle_message_;
  std::uint32_t in_force_id_ = 0;
  std::uint32_t accepted_id_ = 0;
  double accepted_start_s_ = 0.0;
  std::uint32_t refused_id_ = 0;
  std::string refused_reason_;
  std::uint32_t near_obstacles_id_ = 0;

  bool begun_ = false;  // not before it is recorded, where it shall be
  ros::Time last_odometry_;
  ros::WallTime started_ = ros::WallTime::now();
  int lockstep_steps_ = 0;
  ros::WallTime next_turn_;

  ros::Publisher command_publisher_;
  ros::Publisher status_publisher_;
  ros::Publisher cycle_publisher_;
  ros::Publisher vessel_publisher_;
  ros::Publisher prediction_publisher_;
  ros::Subscriber trajectory_subscriber_;
  ros::Subscriber near_subscriber_;
  ros::Subscriber odometry_subscriber_;
  ros::Subscriber recording_subscriber_;
  ros::WallTimer status_timer_;
  std::unique_ptr<ControlLoop> loop_;  // absent in lockstep
};

Result<std::unique_ptr<TrackerNode>> TrackerNode::create(config::Section section) {
  const Result<Setup> setup = readSetup(std::move(section));
  if (!setup) {
    return failure(setup.error().message);
  }
  return vessel::loadParameters(setup->node.vessel).map([&](const vessel::Parameters& vessel) {
    return std::unique_ptr<TrackerNode>(new TrackerNode(setup->node, setup->tracker, vessel));
  });
}

TrackerNode::TrackerNode(TrackerNodeOptions options, const tracker::Options& tracker,
                         const vessel::Parameters& vessel)
    : options_(std::move(options)),
      diagnostics_(node_, private_node_, vessel.name),
      tracker_(tracker::Tracker::create(tracker, vessel)),
      period_s_(tracker.period_s),
      command_publisher_(node_.advertise<ThrusterCommand>("thruster_command", kQueue)),
      status_publisher_(node_.advertise<TrackerStatus>("tracker_status", kQueue)),
      cycle_publisher_(node_.advertise<TrackerCycle>("tracker_cycle", kQueue, true)),
      vessel_publisher_(node_.advertise<std_msgs::String>("vessel", 1, true)),
      prediction_publisher_(node_.advertise<nav_msgs::Path>("predicted_path", kQueue)) {
  command_message_.header.frame_id = frames().base;
  // Latched, and cycle zero: whoever has it misses no cycle.
  cycle_message_.header.frame_id = frames().map;
  cycle_publisher_.publish(cycle_message_);
  std_msgs::String file;
  file.data = vessel::toYaml(vessel);
  vessel_publisher_.publish(file);
  const ros::TransportHints no_delay = ros::TransportHints().tcpNoDelay();
  trajectory_subscriber_ =
      node_.subscribe("trajectory", kQueue, &TrackerNode::onTrajectory, this, no_delay);
  near_subscriber_ =
      node_.subscribe("near_obstacles", kQueue, &TrackerNode::onNearObstacles, this, no_delay);
  odometry_subscriber_ = node_.subscribe("odom", kQueue, &TrackerNode::onOdometry, this, no_delay);
  status_timer_ = node_.createWallTimer(
      ros::WallDuration(1.0 / (kStatusRateHz * std::max(1.0, options_.speed))),
      [this](const ros::WallTimerEvent&) { publishStatus(); });
  if (options_.recorded) {
    recording_subscriber_ = node_.subscribe<std_msgs::Header>(
        "recording", 1, [this](const std_msgs::HeaderConstPtr&) { begin(); });
  } else {
    begin();
  }
}

void TrackerNode::begin() {
  if (!options_.lockstep && !begun_) {
    loop_ = std::make_unique<ControlLoop>(
        ControlLoop::Options{period_s_, options_.speed, kPredictionInterval}, *tracker_,
        statistics_, [] { return ros::Time::now().toSec(); },
        [this](const ControlOutput& output) { publish(output); });
  }
  begun_ = true;
}

std::vector<config::NumberField> TrackerNode::live() const {
  return config::numbersOf(tracker_->options().flatness, "tracker/flatness/");
}

Status TrackerNode::change(config::Section section) {
  return readSetup(std::move(section)).map([this](const Setup& setup) {
    tracker_->setWeights(setup.tracker.flatness);
  });
}

void TrackerNode::onTrajectory(const Trajectory& message) {
  diagnostics_.received("trajectory");
  const double start_s = message.header.stamp.toSec();
  Status taken =
      ros_bridge::toTrajectory(message, frames().map)
          .and_then([&](const trajectory::TimedTrajectory& timed) -> Status {
            if (timed.trajectory.empty()) {
              // In lockstep no step may depend on when the message came.
              tracker_->requestStop("asked to stop", options_.lockstep ? start_s : 0.0, message.id);
              return {};
            }
            return tracker_->setTrajectory(timed, message.id);
          });
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (taken) {
      accepted_id_ = message.id;
      accepted_start_s_ = start_s;
      if (refused_id_ == message.id) {
        refused_id_ = 0;
        refused_reason_.clear();
      }
    } else {
      refused_id_ = message.id;
      refused_reason_ = taken.error().message;
    }
  }
  if (!taken) {
    diagnostics_.refuse("trajectory", taken.error().message);
  }
  publishStatus();
}

void TrackerNode::onNearObstacles(const NearObstacles& message) {
  diagnostics_.received("near_obstacles");
  const Status taken = ros_bridge::toNearObstacles(message, frames().map)
                           .and_then([&](tracker::NearObstacles near) -> Status {
                             // In lockstep no step may depend on when the message came.
                             if (!options_.lockstep) {
                               near.start_s = 0.0;
                             }
                             return tracker_->setNearObstacles(std::move(near), message.id);
                           });
  if (!taken) {
    diagnostics_.refuse("near_obstacles", taken.error().message);
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    near_obstacles_id_ = message.id;
  }
  if (options_.lockstep) {
    publishStatus();  // who sent it waits
  }
}

void TrackerNode::onOdometry(const nav_msgs::Odometry& message) {
  if (!begun_) {
    return;
  }
  diagnostics_.received("odom");
  const Result<ros_bridge::OdometrySample> sample = ros_bridge::odometrySample(
      message, ros_bridge::odometryFrame(options_.odometry_frame), frames().base);
  const ros::Time stamp = message.header.stamp;
  const ros::Time now = options_.lockstep ? ros::Time() : ros::Time::now();
  if (const char* fault = outOfOrder(stamp, last_odometry_, now)) {
    diagnostics_.refuse("odom", fault);
    return;
  }
  if (options_.lockstep && stamp == last_odometry_ && !stamp.isZero()) {
    command_publisher_.publish(command_message_);  // asked again
    cycle_publisher_.publish(cycle_message_);
    return;
  }
  if (sample || options_.lockstep) {
    last_odometry_ = stamp;
  }
  if (sample) {
    tracker_->addOdometry(sample->stamp_s, sample->state, -sample->pitch_rad);
  } else {
    diagnostics_.refuse("odom", sample.error().message);
  }
  if (options_.lockstep) {
    controlStep(stamp);
  }
}

void TrackerNode::controlStep(const ros::Time& stamp) {
  const ros::WallTime now = ros::WallTime::now();
  ControlOutput output;
  const double solver_ms = timedStep(*tracker_, stamp.toSec(), output.command);
  output.has_prediction = lockstep_steps_++ % kPredictionInterval == 0;
  if (output.has_prediction) {
    output.prediction = tracker_->prediction();
  }
  command_message_.header.stamp = stamp;
  publish(output);
  if (told_s_ == output.command.stamp_s) {
    publishStatus();
  }
  tracker_->prepare(stamp.toSec() + period_s_);
  statistics_.add(solver_ms, latenessMs(now));
}

double TrackerNode::latenessMs(const ros::WallTime& now) {
  if (options_.speed <= 0.0) {
    return 0.0;
  }
  const ros::WallDuration period(period_s_ / options_.speed);
  next_turn_ = next_turn_ + period;
  const ros::WallDuration late = now - next_turn_;
  if (late < ros::WallDuration(0.0) || late > period) {
    next_turn_ = now;
  }
  return std::max(0.0, late.toSec() * 1e3);
}

void TrackerNode::publish(const ControlOutput& output) {
  const std::lock_guard<std::mutex> lock(mutex_);
  // In lockstep a status tells of the same steps every time, whenever it is sent.
  if (!options_.lockstep || output.command.stamp_s > told_s_ + kLockstepStatusPeriodS - 1e-6) {
    told_s_ = output.command.stamp_s;
    last_command_ = output.command;
    if (output.command.stamp_s >= accepted_start_s_) {
      in_force_id_ = accepted_id_;
    }
  }
  if (!options_.lockstep) {
    command_message_.header.stamp = ros_bridge::toRosTime(output.command.stamp_s);
  }
  command_message_.left = output.command.thrusts[vessel::kLeft];
  command_message_.right = output.command.thrusts[vessel::kRight];
  command_publisher_.publish(command_message_);
  publishCycle(output.command);
  if (output.has_prediction) {
    last_prediction_ = output.prediction;
    publishPrediction(output.prediction);
  }
}

void TrackerNode::publishCycle(const tracker::Command& command) {
  TrackerCycle& message = cycle_message_;
  message.header.stamp = command_message_.header.stamp;
  message.time = command.stamp_s;
  message.cycle = command.cycle;
  message.odometry_taken = command.odometry_taken;
  message.odometry_time = command.odometry_stamp_s;
  message.trajectory_taken = command.order_taken;
  message.near_obstacles_taken = command.near_taken;
  const tracker::Weights& w = command.weights;
  message.weights = {w.position, w.heading, w.surge, w.sway, w.yaw_rate, w.thrust};
  message.state = tracker::name(command.mode);
  message.left = command_message_.left;
  message.right = command_message_.right;
  std::copy_n(command.reference.data(), vessel::kStateSize, message.reference.begin());
  std::copy_n(command.estimate.data(), vessel::kStateSize, message.estimate.begin());
  const vessel::Disturbance& disturbance = command.disturbance.mean;
  message.disturbance = {command.outside_force_n.x(), command.outside_force_n.y(),
                         command.outside_moment_nm};
  message.force = {disturbance.force_n.x(), disturbance.force_n.y(), disturbance.moment_nm};
  message.wind = {disturbance.wind_mps.x(), disturbance.wind_mps.y()};
  message.current = {disturbance.current_mps.x(), disturbance.current_mps.y()};
  message.solver = tracker::name(command.solver);
  message.solver_iterations = static_cast<std::uint16_t>(command.solver_iterations);
  cycle_publisher_.publish(message);
}

void TrackerNode::publishPrediction(const tracker::Prediction& prediction) {
  if (prediction_publisher_.getNumSubscribers() == 0) {
    return;
  }
  nav_msgs::Path path;
  path.header.frame_id = frames().map;
  path.header.stamp = ros_bridge::toRosTime(prediction.start_s);
  for (int i = 0; i < prediction.size; ++i) {
    const vessel::State& state = prediction.states[static_cast<std::size_t>(i)];
    path.poses.push_back(
        ros_bridge::toPose({state.head<2>(), state[vessel::kPsi]}, frames().map,
                           ros_bridge::toRosTime(prediction.start_s + i * prediction.step_s)));
  }
  prediction_publisher_.publish(path);
}

void TrackerNode::publishStatus() {
  const TrackerStatus message = status();
  status_publisher_.publish(message);
  tracker::Command command;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    command = last_command_;
  }
  if (command.mode == tracker::Mode::kIdle && lacksOdometry()) {
    diagnostics_.setState(Level::kWarning, message.state + ": no odometry");
  } else {
    diagnostics_.setState(levelOf(command), message.reason.empty()
                                                ? message.state
                                                : message.state + ": " + message.reason);
  }
  diagnostics_.setValue("cycles on time, share", message.cycles_on_time);
  diagnostics_.setValue("solver", std::string(tracker::name(command.solver)));
  diagnostics_.setValue("solver iterations", command.solver_iterations);
  diagnostics_.setValue("solver median, ms", message.solver_ms_median);
  diagnostics_.setValue("solver p99, ms", message.solver_ms_p99);
  diagnostics_.setValue("position error, m", message.position_error);
  diagnostics_.setValue("cross error, m", message.cross_error);
  diagnostics_.setValue("heading error, rad", message.heading_error);
  diagnostics_.setValue("time left, s", message.time_left);
}

bool TrackerNode::lacksOdometry() const {
  return last_odometry_.isZero() ? (ros::WallTime::now() - started_).toSec() > kOdometryLateS
                                 : age(last_odometry_, ros::Time::now()) > kOdometryLateS;
}

TrackerStatus TrackerNode::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const tracker::Command& command = last_command_;
  const Eigen::Vector2d error = (command.estimate - command.reference).head<2>();
  const double psi_rad = command.reference[vessel::kPsi];
  const Eigen::Vector2d ahead = unitVector(psi_rad);
  const CycleStatistics::Summary cycles = statistics_.summary();
  TrackerStatus message;
  message.header.frame_id = frames().map;
  message.header.stamp = ros_bridge::toRosTime(command.stamp_s);
  message.state = tracker::name(command.mode);
  message.reason = command.reason;
  message.trajectory_id = in_force_id_;
  message.accepted_id = accepted_id_;
  message.refused_id = refused_id_;
  message.refused_reason = refused_reason_;
  message.near_obstacles_id = near_obstacles_id_;
  message.time_left = command.time_left_s;
  message.at_goal = static_cast<std::uint8_t>(command.at_goal);
  message.position_error = command.tracking_error_m;
  message.along_error = error.dot(ahead);
  message.cross_error = cross(ahead, error);
  message.heading_error = wrapAngle(command.estimate[vessel::kPsi] - psi_rad);
  message.speed_error = command.estimate[vessel::kSurge] - command.reference[vessel::kSurge];
  message.solver_ms_median = cycles.solver_ms_median;
  message.solver_ms_p99 = cycles.solver_ms_p99;
  message.cycle_lateness_ms_max = cycles.lateness_ms_max;
  message.cycles_on_time = cycles.on_time_share;
  message.disturbance = {command.outside_force_n.x(), command.outside_force_n.y(),
                         command.outside_moment_nm};
  message.estimate = ros_bridge::toMessage(command.disturbance);
  message.foreseen = ros_bridge::toMessage(last_prediction_.foreseen());
  return message;
}

}  // namespace otter_nav::nodes

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::TrackerNode>(argc, argv, "tracker_node");
}
