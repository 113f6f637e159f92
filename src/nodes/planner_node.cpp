// planner_node: takes goals, plans, watches the way and plans anew when it must. The decisions are
// mission::Supervisor's; this wires them. Parameters: config/planner_node.yaml, and the rooms' own
// under ~planner (config/planner.yaml) and ~supervisor (config/mission.yaml).
#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <otter_nav/TrackerStatus.h>
#include <otter_nav/Tracks.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "goal_server.hpp"
#include "odometry_history.hpp"
#include "otter_nav/base/first_failure.hpp"
#include "otter_nav/config/field_list.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/mission/near_obstacles.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/ros/diagnostics.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/map_mirror.hpp"
#include "otter_nav/ros/parameters.hpp"
#include "otter_nav/ros/run_node.hpp"
#include "otter_nav/ros/tracks.hpp"
#include "otter_nav/stopping/splice.hpp"
#include "otter_nav/tracker/near_obstacles.hpp"
#include "plan_worker.hpp"
#include "planner_node_options.hpp"
#include "planner_publisher.hpp"
#include "stamps.hpp"
#include "tracker_watch.hpp"

namespace otter_nav::nodes {
namespace {

using ros_bridge::frames;
using Level = ros_bridge::Diagnostics::Level;
using mission::Phase;

constexpr int kQueue = 100;
constexpr double kDecisionPeriodS = 0.05;  // of wall time, when not in lockstep
// In lockstep the tracker's statuses, ten a second, count once they are this old: all are there
// then.
constexpr double kTrackerAgeS = 0.2;
constexpr double kNearPeriodS = 0.1;  // of what is told of near obstacles, out of lockstep
constexpr double kInputPeriodS = 0.5;
constexpr double kInputLateS = 5.0;       // of wall time: then it is missed
constexpr double kInputPatienceS = 20.0;  // of wall time a goal waits for map and odometry
constexpr char kStopped[] = "stopped by the operator";
constexpr char kNotReady[] = "there is no map or odometry";

PlanWorker::Options workerOptions(const PlannerNodeOptions& node, const planner::Options& planner) {
  PlanWorker::Options options;
  options.planner = planner;
  options.planner.keep_trees = true;
  if (node.lockstep) {
    options.max_iterations = node.lockstep_iterations;
  } else {
    options.budget_s = node.planning_budget_s;
  }
  options.use_topology_node = node.use_topology_node;
  return options;
}

// In lockstep an order counts from its decision's date on, which the tracker has not reached when
// it comes: begun in the past, it would take over at whichever step is next.
trajectory::TimedTrajectory beginningAt(double now_s, const trajectory::TimedTrajectory& order) {
  const double elapsed_s = order.elapsed(now_s);
  if (elapsed_s <= 0.0 || elapsed_s >= order.trajectory.duration()) {
    return order;
  }
  trajectory::TimedTrajectory next = order;
  next.trajectory = stopping::remainder(order.trajectory, elapsed_s);
  next.start_time_s = now_s;
  return next;
}

}  // namespace

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
  [[nodiscard]] static std::unique_ptr<mission::Supervisor> createSupervisor(const Setup& setup);
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
  void tellWhatIsNear();
  void noteScan(const map_msgs::OccupancyGridUpdate& update);
  // The moment of a decision; false if there is no place or map yet.
  bool lookUp();
  // The clock was set back: what was decided and sailed is dated by another.
  void beginAnew();
  [[nodiscard]] bool isReady() const { return map_.ready() && !odometry_.empty(); }
  [[nodiscard]] bool isUnderWay() const;
  // What follows from the supervisor's phase: results of the goal, status, acknowledgement.
  void settle();
  void checkInputs();
  void showState();
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
  ros::Time tracks_stamp_;
  std::optional<double> scanned_s_;  // when a scan came into the map last
  std::unique_ptr<mission::Supervisor> supervisor_;
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
  std::uint32_t near_id_ = 0;       // of the near obstacles told last
  bool some_are_near_ = false;      // by these
  double near_told_s_ = 0.0;

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

Result<PlannerNode::Setup> PlannerNode::readSetup(config::Section section) {
  Setup setup;
  const Status node = config::readFields(section, setup.node);
  const auto supervisor = mission::readSupervisorOptions(section.child("supervisor"));
  const auto planner = config::read<planner::Options>(section.child("planner"));
  const auto topology = config::read<topology::Options>(section.child("topology"));
  const auto vessel = vessel::loadParameters(setup.node.vessel);
  if (const Status status =
          firstFailure(node, section.finish(), supervisor, planner, topology, vessel);
      !status) {
    return failure(status.error().message);
  }
  setup.vessel = *vessel;
  setup.supervisor = *supervisor;
  setup.planner = *planner;
  setup.planner.topology = *topology;
  return setup;
}

Result<std::unique_ptr<PlannerNode>> PlannerNode::create(config::Section section) {
  return readSetup(std::move(section)).map([](const Setup& setup) {
    return std::unique_ptr<PlannerNode>(new PlannerNode(setup));
  });
}

std::unique_ptr<mission::Supervisor> PlannerNode::createSupervisor(const Setup& setup) {
  return mission::Supervisor::create(setup.supervisor, setup.vessel,
                                     static_cast<std::uint64_t>(setup.node.seed));
}

PlannerNode::PlannerNode(const Setup& setup)
    : setup_(setup),
      diagnostics_(node_, private_node_, setup.vessel.name),
      map_(setup.node.distance_field),
      supervisor_(createSupervisor(setup)),
      publisher_(node_, setup.vessel, setup.node.lockstep ? 0 : ros::WallTime::now().sec),
      acknowledgement_(node_.advertise<std_msgs::Header>("lockstep_ack", kQueue)),
      goals_(
          node_, [this](const vessel::Pose& goal) { return onGoal(goal); }, [this] { onCancel(); }),
      worker_(workerOptions(setup.node, setup.planner), setup.vessel,
              [this](const mission::PlanRequest& request, const planner::Plan& plan,
                     double wall_ms) { onPlanDone(request, plan, wall_ms); }) {
  const ros::TransportHints no_delay = ros::TransportHints().tcpNoDelay();
  map_subscriber_ = node_.subscribe("map", 1, &PlannerNode::onMap, this);
  update_subscriber_ =
      node_.subscribe("map_updates", kQueue, &PlannerNode::onUpdate, this, no_delay);
  odometry_subscriber_ = node_.subscribe("odom", kQueue, &PlannerNode::onOdometry, this, no_delay);
  tracker_subscriber_ =
      node_.subscribe("tracker_status", kQueue, &PlannerNode::onTrackerStatus, this, no_delay);
  tracks_subscriber_ = node_.subscribe("tracks", 1, &PlannerNode::onTracks, this);
  serve("pause", &PlannerNode::pause);
  serve("hold", &PlannerNode::hold);
  serve("resume", &PlannerNode::resume);
  serve("stop", &PlannerNode::stop);
  if (!setup_.node.lockstep) {
    decision_timer_ = node_.createWallTimer(ros::WallDuration(kDecisionPeriodS),
                                            [this](const ros::WallTimerEvent&) { decide(); });
  }
  input_timer_ = node_.createWallTimer(ros::WallDuration(kInputPeriodS),
                                       [this](const ros::WallTimerEvent&) { checkInputs(); });
}

void PlannerNode::onMap(const nav_msgs::OccupancyGrid& message) {
  diagnostics_.received("map");
  if (const Status status = map_.take(message); !status) {
    diagnostics_.refuse("map", status.error().message);
  }
  decideInTurn();
}

void PlannerNode::onUpdate(const map_msgs::OccupancyGridUpdateConstPtr& message) {
  diagnostics_.received("map_updates");
  if (setup_.node.lockstep) {
    updates_.push_back(message);
    decideInTurn();
  } else {
    if (const auto changed = map_.take(*message); !changed) {
      diagnostics_.refuse("map_updates", changed.error().message);
    } else {
      noteScan(*message);
    }
    decide();
  }
}

// Without a cell it was refused; without a stamp what changed came from no scan.
void PlannerNode::noteScan(const map_msgs::OccupancyGridUpdate& update) {
  if (!update.data.empty() && !update.header.stamp.isZero()) {
    scanned_s_ = update.header.stamp.toSec();
  }
}

void PlannerNode::onOdometry(const nav_msgs::Odometry& message) {
  diagnostics_.received("odom");
  const Result<ros_bridge::OdometrySample> sample = ros_bridge::odometrySample(
      message, ros_bridge::odometryFrame(setup_.node.odometry_frame), frames().base);
  const ros::Time now = ros::Time::now();
  if (!setup_.node.lockstep) {
    odometry_.forgetWhatIsAhead(now);
  }
  if (!sample) {
    diagnostics_.refuse("odom", sample.error().message);
  } else if (!setup_.node.lockstep && isAhead(message.header.stamp, now)) {
    diagnostics_.refuse("odom", kStampedAhead);
  } else if (!odometry_.add(*sample)) {
    diagnostics_.refuse("odom", kStampedBack);
  }
  decideInTurn();
}

void PlannerNode::onTrackerStatus(const TrackerStatus& message) {
  diagnostics_.received("tracker_status");
  tracker_.take(message);
  settle();
  decideInTurn();
}

void PlannerNode::onTracks(const Tracks& message) {
  diagnostics_.received("tracks");
  Result<ros_bridge::SoundTracks> sound = ros_bridge::toTracks(message);
  if (!sound) {
    diagnostics_.refuse("tracks", sound.error().message);
    return;
  }
  const ros::Time now = setup_.node.lockstep ? ros::Time() : ros::Time::now();
  if (const char* fault = outOfOrder(message.header.stamp, tracks_stamp_, now)) {
    diagnostics_.refuse("tracks", fault);
    return;
  }
  if (!sound->refused.empty()) {
    diagnostics_.refuse("tracks", sound->refused);
  }
  tracks_ = std::move(sound->tracks);
  tracks_stamp_ = message.header.stamp;
}

void PlannerNode::decideInTurn() {
  while (setup_.node.lockstep && !updates_.empty() && map_.ready() && !unacknowledged_) {
    const ros::Time stamp = updates_.front()->header.stamp;
    const auto vessel = odometry_.at(stamp.toSec());
    const double told_s = stamp.toSec() - kTrackerAgeS;
    if (!vessel || !tracker_.complete(told_s)) {
      return;
    }
    tracker_.countUntil(told_s);
    if (const auto changed = map_.take(*updates_.front()); !changed) {
      diagnostics_.refuse("map_updates", changed.error().message);
    } else {
      noteScan(*updates_.front());
    }
    updates_.pop_front();
    unacknowledged_ = stamp;
    if (stamp > acknowledged_) {
      vessel_ = *vessel;
      now_s_ = stamp.toSec() + setup_.node.lockstep_lag_s;
      execute(supervisor_->update(now_s_, situation(), obstacles()));
      tellWhatIsNear();
    }
    goals_.setReady(true);
    goals_.retryWaiting();
    settle();
  }
}

bool PlannerNode::lookUp() {
  const ros::Time now = ros::Time::now();
  odometry_.forgetWhatIsAhead(now);
  if (isAhead(ros_bridge::toRosTime(now_s_), now)) {
    beginAnew();
    now_s_ = now.toSec();
  }
  if (!isReady()) {
    return false;
  }
  vessel_ = odometry_.latest();
  now_s_ = std::max(now.toSec(), vessel_.stamp_s);
  return true;
}

void PlannerNode::beginAnew() {
  constexpr char kSetBack[] = "the clock was set back";
  const double now_s = ros::Time::now().toSec();
  ROS_WARN_STREAM(kSetBack << ", by " << now_s_ - now_s
                           << " s: what was stamped before is forgotten");
  if (isUnderWay()) {
    sent_id_ = publisher_.publishStop(now_s, supervisor_->goal());
  }
  goals_.abort(kSetBack);
  worker_.forget();
  plan_under_way_ = 0;
  supervisor_ = createSupervisor(setup_);
  tracker_ = TrackerWatch();
  tracker_.expect(sent_id_, true);
  tracks_.clear();
  tracks_stamp_ = ros::Time();
  // Until odometry of the new time has come there is none, and a goal waits for it.
  vessel_.stamp_s = 0.0;
  goals_.setReady(false);
  if (scanned_s_) {
    scanned_s_ = now_s;
  }
}

void PlannerNode::decide() {
  if (!lookUp()) {
    return;
  }
  tracker_.countUntil(std::numeric_limits<double>::infinity());
  execute(supervisor_->update(now_s_, situation(), obstacles()));
  if (std::abs(now_s_ - near_told_s_) >= kNearPeriodS) {
    tellWhatIsNear();
  }
  goals_.setReady(true);
  goals_.retryWaiting();
  settle();
}

// Where nothing was and nothing is, nothing is told.
void PlannerNode::tellWhatIsNear() {
  std::vector<Eigen::Vector2d> near = mission::nearObstacles(
      map_.field(), setup_.vessel.hull, {vessel_.state.head<2>(), vessel_.state[vessel::kPsi]},
      tracker_.foreseen(), tracker::kMostNearObstacles);
  near_told_s_ = now_s_;
  if (near_id_ == 0 || some_are_near_ || !near.empty()) {
    some_are_near_ = !near.empty();
    near_id_ = publisher_.publishNear(now_s_, std::move(near));
  }
}

Status PlannerNode::onGoal(const vessel::Pose& goal) {
  Result<mission::Orders> orders = supervisor_->setGoal(now_s_, goal, situation(), obstacles());
  if (!orders) {
    return failure(orders.error().message);
  }
  execute(*orders);
  settle();
  return {};
}

void PlannerNode::onCancel() {
  execute(supervisor_->cancel(now_s_, situation(), obstacles()));
  settle();
}

void PlannerNode::serve(const std::string& name, Result<mission::Orders> (PlannerNode::*wish)()) {
  const auto answer = [this, wish](std_srvs::Trigger::Request&,
                                   std_srvs::Trigger::Response& response) {
    const Result<mission::Orders> orders = (this->*wish)();
    response.success = static_cast<std::uint8_t>(orders.has_value());
    if (orders) {
      execute(*orders);
      settle();
      response.message = mission::name(supervisor_->phase());
    } else {
      response.message = orders.error().message;
    }
    return true;
  };
  wishes_.push_back(
      private_node_.advertiseService<std_srvs::Trigger::Request, std_srvs::Trigger::Response>(
          name, answer));
}

Result<mission::Orders> PlannerNode::pause() {
  if (!isReady()) {
    return failure(kNotReady);
  }
  return supervisor_->pause(now_s_, situation(), obstacles());
}
Result<mission::Orders> PlannerNode::hold() {
  if (!isReady()) {
    return failure(kNotReady);
  }
  return supervisor_->hold(now_s_, situation(), obstacles());
}
Result<mission::Orders> PlannerNode::resume() {
  if (!isReady()) {
    return failure(kNotReady);
  }
  return supervisor_->resume(now_s_, situation(), obstacles());
}
// Nor does a goal that waits for map and odometry set out when they come.
Result<mission::Orders> PlannerNode::stop() {
  const bool waited = goals_.abortWaiting(kStopped);
  if (!isReady()) {
    return waited ? Result<mission::Orders>(mission::Orders{}) : failure(kNotReady);
  }
  goals_.abort(kStopped);
  return supervisor_->cancel(now_s_, situation(), obstacles(), kStopped);
}

void PlannerNode::onPlanDone(const mission::PlanRequest& request, const planner::Plan& plan,
                             double wall_ms) {
  publisher_.publishPlan(plan, wall_ms);
  diagnostics_.setValue("last plan", planner::toString(plan.outcome));
  diagnostics_.setValue("last plan, ms", wall_ms);
  if (plan.outcome != planner::Outcome::kSolved) {
    ROS_INFO_STREAM("No plan at clearance " << request.query.limits.clearance_m
                                            << " m: " << plan.reason);
  }
  if (plan_under_way_ == request.id) {
    plan_under_way_ = 0;
  }
  if (!setup_.node.lockstep) {
    (void)lookUp();
  }
  execute(supervisor_->planFinished(now_s_, request.id, plan, situation(), obstacles()));
  settle();
  decideInTurn();
}

void PlannerNode::execute(const mission::Orders& orders) {
  if (orders.plan) {
    plan_under_way_ = orders.plan->id;
    worker_.start(*orders.plan, map_.field(), map_.stamp());
  }
  if (orders.sail) {
    sent_id_ =
        publisher_.publish(setup_.node.lockstep ? beginningAt(now_s_, *orders.sail) : *orders.sail,
                           supervisor_->goal());
    tracker_.expect(sent_id_, false);
  } else if (orders.stop) {
    sent_id_ = publisher_.publishStop(now_s_, supervisor_->goal());
    tracker_.expect(sent_id_, true);
  }
  // The map around the way may have changed whenever the phase does.
  if (orders.sail || orders.stop || shown_ != supervisor_->phase()) {
    shown_ = supervisor_->phase();
    publisher_.show(*supervisor_, map_.field());
  }
}

void PlannerNode::settle() {
  const bool handed_over = sent_id_ == 0 || tracker_.answered(sent_id_);
  if (setup_.node.lockstep &&
      (plan_under_way_ != 0 || !handed_over || !tracker_.hasNearObstacles(near_id_))) {
    return;
  }
  if (handed_over) {
    confirmed_id_ = sent_id_;
  }
  const Phase phase = supervisor_->phase();
  publisher_.publishStatus(*supervisor_, now_s_, confirmed_id_);
  goals_.feedback({vessel_.state.head<2>(), vessel_.state[vessel::kPsi]},
                  ros_bridge::toRosTime(vessel_.stamp_s));
  if (phase == Phase::kArrived) {
    goals_.succeed(supervisor_->reason().empty() ? "arrived" : "arrived: " + supervisor_->reason());
  } else if (phase == Phase::kFailed) {
    goals_.abort(supervisor_->reason());
  }
  showState();
  diagnostics_.setValue("replans", supervisor_->replans().all);
  diagnostics_.setValue("replans for the weather", supervisor_->replans().for_weather);
  diagnostics_.setValue("stops", supervisor_->stops());
  diagnostics_.setValue("speed limit, m/s", supervisor_->speedMax());
  diagnostics_.setValue("tracking error, m", situation().tracking_error_m);
  if (unacknowledged_) {
    acknowledged_ = std::max(acknowledged_, *unacknowledged_);
    unacknowledged_.reset();
    std_msgs::Header acknowledgement;
    acknowledgement.stamp = acknowledged_;
    acknowledgement.frame_id = ros_bridge::nodeName();
    acknowledgement_.publish(acknowledgement);
  }
}

// A goal that came before map and odometry waits for them, but not for ever.
void PlannerNode::checkInputs() {
  if (const auto waited = goals_.waiting(); waited && waited->toSec() > kInputPatienceS) {
    (void)goals_.abortWaiting(!map_.ready()       ? "there is no map"
                              : odometry_.empty() ? "there is no odometry"
                                                  : "there are no map updates");
  }
  showState();
}

bool PlannerNode::isUnderWay() const {
  const Phase phase = supervisor_->phase();
  return phase != Phase::kIdle && phase != Phase::kArrived && phase != Phase::kFailed;
}

void PlannerNode::showState() {
  const Phase phase = supervisor_->phase();
  const bool under_way = isUnderWay();
  // In lockstep time stands still without inputs.
  const auto late = [&](const char* topic) {
    return !setup_.node.lockstep && diagnostics_.silence(topic) > kInputLateS;
  };
  const char* lacks = !map_.ready() && diagnostics_.silence("map") > kInputLateS        ? "map"
                      : odometry_.empty() && diagnostics_.silence("odom") > kInputLateS ? "odometry"
                      : late("odom")                                                    ? "odometry"
                      : under_way && late("map_updates") ? "map updates"
                                                         : nullptr;
  const bool stopped = phase == Phase::kStopping || phase == Phase::kStopped;
  const Level level =
      phase == Phase::kFailed ? Level::kError
      : lacks != nullptr || (stopped && !supervisor_->reason().empty()) || tracker_.gaveUp()
          ? Level::kWarning
          : Level::kOk;
  std::string told(mission::name(phase));
  if (!supervisor_->reason().empty()) {
    told += ": " + supervisor_->reason();
  }
  if (lacks != nullptr) {
    told += std::string("; no ") + lacks;
  }
  diagnostics_.setState(level, told);
}

std::vector<config::NumberField> PlannerNode::live() const {
  const std::string prefix = "supervisor/";
  std::vector<config::NumberField> fields = config::numbersOf(setup_.supervisor, prefix);
  const auto fixed = [&](const config::NumberField& field) {
    return field.path == prefix + "planning_latency_s" ||
           field.path == prefix + "rounds_from_rest" || field.path == prefix + "stops_max" ||
           field.path.rfind(prefix + "encounter/", 0) == 0;
  };
  fields.erase(std::remove_if(fields.begin(), fields.end(), fixed), fields.end());
  return fields;
}

Status PlannerNode::change(config::Section section) {
  return readSetup(std::move(section)).map([this](const Setup& setup) {
    setup_.supervisor = setup.supervisor;
    supervisor_->setOptions(setup.supervisor);
  });
}

feasibility::Obstacles PlannerNode::obstacles() const {
  feasibility::Obstacles obstacles(map_.field());
  obstacles.setKnownWater(map_.knownWater());
  return obstacles;
}

mission::Situation PlannerNode::situation() const {
  mission::Situation situation;
  situation.state = vessel_.state;
  situation.odometry_stamp_s = vessel_.stamp_s;
  situation.scanned_s = scanned_s_;
  const trajectory::TimedTrajectory& sailed = supervisor_->sailed();
  if (const std::optional<double> off_m = tracker_.trackingError(vessel_.stamp_s)) {
    situation.tracking_error_m = *off_m;
  } else if (!sailed.trajectory.empty() && vessel_.stamp_s >= sailed.start_time_s) {
    const vessel::FlatPoint reference = sailed.trajectory.flat(sailed.elapsed(vessel_.stamp_s));
    situation.tracking_error_m = (reference.position - vessel_.state.head<2>()).norm();
  }
  situation.disturbance = tracker_.estimate();
  situation.tracker_fault = tracker_.gaveUp();
  situation.tracker_reason = tracker_.reason();
  situation.foreseen = tracker_.foreseen();
  constexpr double kTracksS = 5.0;  // older ones tell nothing of where others are
  if (std::abs(now_s_ - tracks_stamp_.toSec()) < kTracksS) {  // ahead if the clock was set back
    situation.tracks = tracks_;
    situation.hears_others = true;
  }
  return situation;
}

}  // namespace otter_nav::nodes

int main(int argc, char** argv) {
  return otter_nav::ros_bridge::runNode<otter_nav::nodes::PlannerNode>(argc, argv, "planner_node");
}
