// plant_node: the vessel in its world behind the topics a real one has. Parameters:
// config/plant_node.yaml, the plant's own under ~plant (config/plant.yaml).
#include <otter_nav/ThrusterCommand.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "lockstep_gate.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/run_node.hpp"
#include "pacer.hpp"
#include "plant_node_options.hpp"
#include "plant_publisher.hpp"

namespace otter_nav::nodes {
namespace {

constexpr int kQueue = 100;
// Simulated time begins here: zero means "no time" to ROS.
constexpr double kStartTimeS = 1.0;
// Of wall time that a node may keep the others waiting; then the plant gives up.
constexpr double kLockstepTimeoutS = 60.0;
// While time stands still the last messages are sent again this often: a node that started late
// missed them.
constexpr std::chrono::milliseconds kRepeatAfter{250};

}  // namespace

class PlantNode {
 public:
  [[nodiscard]] static Result<std::unique_ptr<PlantNode>> create(config::Section section);
  ~PlantNode();
  PlantNode(const PlantNode&) = delete;
  PlantNode& operator=(const PlantNode&) = delete;

  [[nodiscard]] int exitCode() const { return exit_code_; }

 private:
  PlantNode(PlantNodeOptions options, plant::Simulator simulator);

  void onCommand(const ThrusterCommand& message);
  void onAcknowledgement(const std_msgs::Header& message);
  void run();
  void publishStep();
  // These return false when the node is to end.
  bool waitForNodes(const ros::Time& now);
  bool takeCommand();
  // Waits until `ready`, which itself waits a little; `what` says what for.
  bool waitPatiently(const std::function<bool()>& ready, const std::function<std::string()>& what);

  PlantNodeOptions options_;
  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  ros_bridge::Diagnostics diagnostics_;
  plant::Simulator simulator_;
  PlantPublisher publisher_;
  LockstepGate gate_;
  ros::Time now_;
  std::vector<ros::Time> pending_scans_;
  ros::Subscriber command_subscriber_;
  ros::Subscriber acknowledgement_subscriber_;
  std::atomic<int> exit_code_{0};
  std::thread thread_;
};

Result<std::unique_ptr<PlantNode>> PlantNode::create(config::Section section) {
  Result<PlantNodeSetup> setup = readPlantNodeSetup(std::move(section));
  if (!setup) {
    return failure(setup.error().message);
  }
  map::OccupancyGrid world;
  if (!setup->node.world.empty()) {
    Result<map::OccupancyGrid> loaded = map::loadChart(setup->node.world);
    if (!loaded) {
      return failure(loaded.error().message);
    }
    world = std::move(*loaded);
  }
  Result<plant::Simulator> simulator =
      plant::Simulator::create(setup->plant, world, static_cast<std::uint64_t>(setup->node.seed));
  if (!simulator) {
    return failure(simulator.error().message);
  }
  simulator->setVessels(setup->node.vessels);
  simulator->placeAt(setup->node.start.head<2>(), setup->node.start.z());
  return std::unique_ptr<PlantNode>(new PlantNode(setup->node, std::move(*simulator)));
}

PlantNode::PlantNode(PlantNodeOptions options, plant::Simulator simulator)
    : options_(std::move(options)),
      diagnostics_(node_, private_node_, options_.vessel),
      simulator_(std::move(simulator)),
      publisher_(node_, simulator_.options().lidar),
      gate_(options_.lockstep_nodes),
      now_(kStartTimeS) {
  diagnostics_.setState(ros_bridge::Diagnostics::Level::kOk,
                        options_.lockstep ? "in lockstep" : "free running");
  command_subscriber_ = node_.subscribe("thruster_command", kQueue, &PlantNode::onCommand, this,
                                        ros::TransportHints().tcpNoDelay());
  acknowledgement_subscriber_ =
      node_.subscribe("lockstep_ack", kQueue, &PlantNode::onAcknowledgement, this,
                      ros::TransportHints().tcpNoDelay());
  thread_ = std::thread([this] { run(); });
}

PlantNode::~PlantNode() {
  ros::requestShutdown();
  thread_.join();
}

void PlantNode::onCommand(const ThrusterCommand& message) {
  if (const Status status =
          ros_bridge::checkFrame(message.header.frame_id, ros_bridge::frames().base);
      !status) {
    diagnostics_.refuse("thruster_command", status.error().message);
    return;
  }
  if (!std::isfinite(message.left) || !std::isfinite(message.right)) {
    diagnostics_.refuse("thruster_command", "left or right is not finite");
    return;
  }
  gate_.command(message.header.stamp.toNSec(), {message.left, message.right});
}

void PlantNode::onAcknowledgement(const std_msgs::Header& message) {
  (void)gate_.acknowledge(message.frame_id, message.stamp.toNSec());
}

void PlantNode::run() {
  Pacer pacer(options_.speed > 0.0 ? options_.control_period_s / options_.speed : 0.0);
  const ros::Duration period(options_.control_period_s);
  publishStep();
  // Nothing moves before everybody has dealt with the first scan.
  if (!waitForNodes(now_ + ros::Duration(options_.lockstep_lag_s))) {
    return;
  }
  pacer.start();
  while (ros::ok() && takeCommand()) {
    pacer.waitForNextTurn();
    simulator_.advance(options_.control_period_s);
    now_ += period;
    if (!waitForNodes(now_)) {
      return;
    }
    publishStep();
  }
}

void PlantNode::publishStep() {
  if (simulator_.radarDue()) {
    publisher_.publishRadar(simulator_.radar(), now_);
  }
  publisher_.publishAis(simulator_.takeAis());
  if (simulator_.scanDue()) {
    publisher_.publishScan(simulator_.scan(), now_);
    pending_scans_.push_back(now_);
  }
  publisher_.publish(simulator_, now_);
}

bool PlantNode::waitForNodes(const ros::Time& now) {
  if (!options_.lockstep) {
    pending_scans_.clear();
    return true;
  }
  const ros::Duration lag(options_.lockstep_lag_s);
  while (!pending_scans_.empty() && pending_scans_.front() + lag <= now) {
    const std::uint64_t stamp_ns = pending_scans_.front().toNSec();
    if (!waitPatiently([&] { return gate_.waitForAcknowledgement(stamp_ns, kRepeatAfter); },
                       [&] { return "an acknowledgement of " + gate_.missing(stamp_ns); })) {
      return false;
    }
    pending_scans_.erase(pending_scans_.begin());
  }
  return true;
}

bool PlantNode::takeCommand() {
  std::optional<vessel::Thrusts> thrusts;
  if (options_.lockstep) {
    const std::uint64_t stamp_ns = now_.toNSec();
    const auto came = [&] {
      thrusts = gate_.waitForCommand(stamp_ns, kRepeatAfter);
      return thrusts.has_value();
    };
    if (!waitPatiently(came, [] { return std::string("a thruster command"); })) {
      return false;
    }
  } else {
    thrusts = gate_.takeLatest();
  }
  if (thrusts) {
    (void)simulator_.command(*thrusts);
  }
  return true;
}

bool PlantNode::waitPatiently(const std::function<bool()>& ready,
                              const std::function<std::string()>& what) {
  const ros::WallTime give_up = ros::WallTime::now() + ros::WallDuration(kLockstepTimeoutS);
  while (!ready()) {
    if (!ros::ok()) {
      return false;
    }
    if (ros::WallTime::now() > give_up) {
      ROS_FATAL_STREAM("Lockstep: waited " << kLockstepTimeoutS << " s for " << what() << " at "
                                           << now_.toSec() << " s");
      exit_code_ = 1;
      ros::requestShutdown();
      return false;
    }
    publisher_.repeat();
  }
  return ros::ok();
}

}  // namespace otter_nav::nodes

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::PlantNode>(argc, argv, "plant_node");
}
