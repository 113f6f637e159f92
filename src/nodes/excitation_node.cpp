// excitation_node: sails the excitation manoeuvres, a thruster command for each odometry message,
// and ends when they are done. Whoever drives the thrusters may hold the last command: without
// odometry, and at the end, it is none. Parameters: config/excitation.yaml and those of
// launch/collect.launch.
#include <nav_msgs/Odometry.h>
#include <otter_nav/ThrusterCommand.h>
#include <ros/node_handle.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "otter_nav/config/section.hpp"
#include "otter_nav/identification/manoeuvres.hpp"
#include "otter_nav/ros/conversions.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/run_node.hpp"
#include "stamps.hpp"

namespace otter_nav::nodes {
namespace {

constexpr int kQueue = 100;
constexpr double kSilenceS = 0.5;  // without odometry that can be taken
constexpr double kLookS = 0.1;

volatile std::sig_atomic_t asked_to_end = 0;
void askToEnd(int /*signal*/) {
  asked_to_end = 1;
}

}  // namespace

struct ExcitationNodeOptions {
  std::string vessel;  // a name of config/vessels, or a file
  // Nothing moves before so many listen to the commands: the plant and the recorder.
  int listeners = 2;
};

class ExcitationNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<ExcitationNode>> create(config::Section section);
  [[nodiscard]] static int exitCode() { return 0; }

 private:
  ExcitationNode(ExcitationNodeOptions options,
                 std::vector<identification::ManoeuvreOptions> manoeuvres,
                 const vessel::Parameters& vessel);

  void onOdometry(const nav_msgs::Odometry& message);
  void reportProgress();
  void look();
  void rest();
  void end();

  ExcitationNodeOptions options_;
  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  identification::Excitation excitation_;
  std::string progress_;
  ThrusterCommand command_;
  ros::Time last_odometry_;
  ros::Time answered_;  // by the clock; none before the first manoeuvre
  bool ending_ = false;
  ros::Publisher command_publisher_;
  ros::Subscriber odometry_subscriber_;
  ros::WallTimer look_timer_;
  ros::WallTimer end_timer_;
};

Result<std::unique_ptr<ExcitationNode>> ExcitationNode::create(config::Section section) {
  ExcitationNodeOptions options;
  section.read("vessel", options.vessel);
  section.read("listeners", options.listeners, {1, 100});
  auto manoeuvres = identification::readExcitation(section);
  if (!manoeuvres) {
    return failure(manoeuvres.error().message);
  }
  return vessel::loadParameters(options.vessel).map([&](const vessel::Parameters& vessel) {
    return std::unique_ptr<ExcitationNode>(
        new ExcitationNode(options, *std::move(manoeuvres), vessel));
  });
}

ExcitationNode::ExcitationNode(ExcitationNodeOptions options,
                               std::vector<identification::ManoeuvreOptions> manoeuvres,
                               const vessel::Parameters& vessel)
    : options_(std::move(options)),
      diagnostics_(node_, private_node_, vessel.name),
      excitation_(std::move(manoeuvres), vessel.thrusters),
      command_publisher_(node_.advertise<ThrusterCommand>("thruster_command", kQueue)) {
  command_.header.frame_id = ros_bridge::frames().base;
  odometry_subscriber_ = node_.subscribe("odom", kQueue, &ExcitationNode::onOdometry, this,
                                         ros::TransportHints().tcpNoDelay());
  look_timer_ = node_.createWallTimer(ros::WallDuration(kLookS),
                                      [this](const ros::WallTimerEvent&) { look(); });
  // Not ROS's own handler: that one cuts the connections first, and the last command is lost.
  std::signal(SIGINT, askToEnd);
  std::signal(SIGTERM, askToEnd);
}

void ExcitationNode::onOdometry(const nav_msgs::Odometry& message) {
  if (ending_ ||
      command_publisher_.getNumSubscribers() < static_cast<std::uint32_t>(options_.listeners)) {
    return;
  }
  const Result<ros_bridge::OdometrySample> sample =
      ros_bridge::odometrySample(message, message.header.frame_id, ros_bridge::frames().base);
  if (!sample) {
    diagnostics_.refuse("odom", sample.error().message);
    return;
  }
  const ros::Time stamp = message.header.stamp;
  const ros::Time now = ros::Time::now();
  if (const char* fault = outOfOrder(stamp, last_odometry_, now)) {
    diagnostics_.refuse("odom", fault);
    return;
  }
  last_odometry_ = stamp;
  answered_ = std::max(now, stamp);
  // A message sent again gets the same answer: the manoeuvres depend on time and state alone.
  const vessel::Thrusts thrusts = excitation_.step(sample->stamp_s, sample->state);
  command_.header.stamp = stamp;
  command_.left = thrusts[vessel::kLeft];
  command_.right = thrusts[vessel::kRight];
  command_publisher_.publish(command_);
  reportProgress();
}

void ExcitationNode::reportProgress() {
  const std::string progress = excitation_.progress();
  if (progress == progress_) {
    return;
  }
  progress_ = progress;
  ROS_INFO_STREAM("Excitation: " << progress_);
  diagnostics_.setState(ros_bridge::Diagnostics::Level::kOk, progress_);
  if (excitation_.finished()) {
    end();
  }
}

// By the clock that odometry has its stamps from: in lockstep it stands while somebody is waited
// for.
void ExcitationNode::look() {
  if (asked_to_end != 0 && !ending_) {
    rest();
    end();
  }
  const ros::Time now = ros::Time::now();
  if (isAhead(answered_, now)) {  // the clock was set back
    answered_ = now;
  }
  if (!ending_ && !answered_.isZero() && age(answered_, now) > kSilenceS) {
    rest();
  }
}

void ExcitationNode::rest() {
  command_.header.stamp = ros::Time::now();
  command_.left = 0.0;
  command_.right = 0.0;
  command_publisher_.publish(command_);
}

// A moment later, so that the last command goes out.
void ExcitationNode::end() {
  ending_ = true;
  end_timer_ = node_.createWallTimer(
      ros::WallDuration(kLookS), [](const ros::WallTimerEvent&) { ros::shutdown(); }, true);
}

}  // namespace otter_nav::nodes

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::ExcitationNode>(argc, argv,
                                                                          "excitation_node");
}
