#include "otter_nav/simulation/closed_loop.hpp"

#include <chrono>
#include <utility>

#include "otter_nav/base/text.hpp"
#include "otter_nav/mission/near_obstacles.hpp"
#include "otter_nav/stopping/splice.hpp"
#include "simulation/sensing.hpp"

namespace otter_nav::simulation {
namespace {

class Stopwatch {
 public:
  [[nodiscard]] double milliseconds() const {
    const auto passed = std::chrono::steady_clock::now() - begin_;
    return std::chrono::duration<double, std::milli>(passed).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

ClosedLoop::ClosedLoop(const LoopOptions& options, plant::Simulator plant, map::OccupancyGrid chart,
                       const scenario::Mission& mission, std::uint64_t seed)
    : options_(options),
      plant_(std::move(plant)),
      sensing_(std::make_unique<Sensing>(std::move(chart), options)),
      planner_(options.planner, options.vessel),
      tracker_(tracker::Tracker::create(options.tracker, options.vessel)),
      supervisor_(mission::Supervisor::create(options.supervisor, options.vessel, seed)),
      goal_(mission.goal) {
  plant_.placeAt(mission.start.position, mission.start.psi_rad);
}

Status ClosedLoop::setSpeedMax(double speed_mps) {
  return supervisor_->setSpeedMax(speed_mps);
}

ClosedLoop::~ClosedLoop() = default;
ClosedLoop::ClosedLoop(ClosedLoop&&) noexcept = default;
ClosedLoop& ClosedLoop::operator=(ClosedLoop&&) noexcept = default;

Result<ClosedLoop> ClosedLoop::create(const LoopOptions& options, Waters waters,
                                      const scenario::Mission& mission, std::uint64_t seed) {
  Result<plant::Simulator> plant = plant::Simulator::create(options.plant, waters.world, seed);
  if (!plant) {
    return failure(plant.error().message);
  }
  plant->setVessels(std::move(waters.vessels));
  ClosedLoop loop(options, std::move(*plant), std::move(waters.chart), mission, seed);
  if (mission.speed_mps) {
    if (const Status status = loop.setSpeedMax(*mission.speed_mps); !status) {
      return failure(status.error().message);
    }
  }
  return loop;
}

bool ClosedLoop::step() {
  if (outcome_) {
    return false;
  }
  sense();
  if (reply_ && time() >= reply_time_s_) {
    const Reply reply = std::move(*reply_);
    reply_.reset();
    carryOut(supervisor_->planFinished(time(), reply.id, reply.plan, situation(), obstacles()));
  }
  control();
  judge();
  return !outcome_.has_value();
}

void ClosedLoop::sense() {
  const plant::Odometry& odometry = plant_.odometry();
  tracker_->addOdometry(odometry.stamp_s, odometry.state, -odometry.pitch_rad);
  if (plant_.radarDue()) {
    sensing_->hear(plant_.radar(), odometry);
  }
  if (const Status status = sensing_->hear(time(), plant_.takeAis()); !status) {
    finish(scenario::Outcome::kError, status.error().message);
    return;
  }
  if (!plant_.scanDue()) {
    return;
  }
  scanned_from_ = plant_.truth();
  scanned_s_ = time();
  if (const Status status = sensing_->insert(plant_.scan(), odometry); !status) {
    finish(scenario::Outcome::kError, status.error().message);
    return;
  }
  lookAround();
  if (!started_) {
    start();
    return;
  }
  carryOut(supervisor_->update(time(), situation(), obstacles()));
}

void ClosedLoop::lookAround() {
  const vessel::State& state = plant_.odometry().state;
  const Status told = tracker_->setNearObstacles(
      {0.0, mission::nearObstacles(
                obstacles().field(), options_.vessel.hull, {state.head<2>(), state[vessel::kPsi]},
                tracker_->prediction().foreseen(), tracker::kMostNearObstacles)});
  if (!told) {
    finish(scenario::Outcome::kError, told.error().message);
  }
}

void ClosedLoop::start() {
  started_ = true;
  const Result<mission::Orders> orders =
      supervisor_->setGoal(time(), goal_, situation(), obstacles());
  if (orders) {
    carryOut(*orders);
  } else {
    finish(scenario::Outcome::kError, orders.error().message);
  }
}

void ClosedLoop::control() {
  const Stopwatch watch;
  command_ = tracker_->step(time());
  recorder_.addTracking(watch.milliseconds());
  plant_.step(command_.thrusts, options_.control_period_s);
  if (time() - last_record_s_ >= options_.record_period_s - 1e-6) {
    last_record_s_ = time();
    recorder_.addMotion(motion());
  }
}

void ClosedLoop::judge() {
  if (plant_.hadContact()) {
    finish(scenario::Outcome::kCollided, "the hull touched " + touched() + " while " +
                                             std::string(mission::name(supervisor_->phase())));
  } else if (plant::capsized(plant_.truth().roll_rad, plant_.truth().pitch_rad)) {
    finish(scenario::Outcome::kCapsized, "turned over by waves and thrust while " +
                                             std::string(mission::name(supervisor_->phase())));
  } else if (supervisor_->phase() == mission::Phase::kArrived) {
    finish(scenario::Outcome::kArrived, supervisor_->reason());
  } else if (supervisor_->phase() == mission::Phase::kFailed) {
    finish(scenario::Outcome::kStopped, supervisor_->reason());
  } else if (!outcome_ && time() >= options_.timeout_s) {
    finish(scenario::Outcome::kTimeout,
           std::string(mission::name(supervisor_->phase())) + ": " + supervisor_->reason());
  }
}

// With our own speed: being run into while at rest is another matter than running into something.
std::string ClosedLoop::touched() const {
  const std::optional<int> vessel = plant_.touchedVessel();
  if (!vessel) {
    return "something";
  }
  return text("vessel %d at %.2f m/s of our own", *vessel, vessel::speedOf(plant_.truth().planar));
}

void ClosedLoop::carryOut(const mission::Orders& orders) {
  if (orders.stop) {
    stop_ordered_ = true;
    tracker_->requestStop("stop ordered");
  }
  if (orders.sail) {
    stop_ordered_ = false;
    if (const Status status = tracker_->setTrajectory(*orders.sail); !status) {
      finish(scenario::Outcome::kError,
             "the tracker refused a trajectory: " + status.error().message);
    }
  }
  if (orders.plan) {
    const Stopwatch watch;
    planner::Termination termination;
    termination.max_iterations = options_.planning_iterations;
    feasibility::Obstacles all = obstacles();
    if (!orders.plan->others.empty()) {
      all.add(orders.plan->others);
    }
    planner::Plan plan =
        planner_.plan(all.startingAt(orders.plan->start_time_s), orders.plan->query, termination);
    recorder_.addPlanning(watch.milliseconds());
    reply_ = Reply{orders.plan->id, std::move(plan)};
    // A little before the new trajectory begins, as in life.
    constexpr double kEarlyS = 0.05;
    reply_time_s_ = time() + options_.supervisor.planning_latency_s - kEarlyS;
  }
}

const std::vector<traffic::Track>& ClosedLoop::tracks() const {
  return sensing_->tracks();
}

feasibility::Obstacles ClosedLoop::obstacles() const {
  return sensing_->obstacles();
}

mission::Situation ClosedLoop::situation() const {
  mission::Situation situation;
  situation.state = plant_.odometry().state;
  situation.odometry_stamp_s = plant_.odometry().stamp_s;
  situation.scanned_s = scanned_s_;
  situation.tracking_error_m = command_.tracking_error_m;
  situation.disturbance = command_.disturbance;
  using tracker::Mode;
  const bool braking = command_.mode == Mode::kStopping || command_.mode == Mode::kStopped;
  situation.tracker_fault = command_.mode == Mode::kFault || (braking && !stop_ordered_);
  situation.tracks = sensing_->tracks();
  situation.hears_others = true;
  situation.tracker_reason = std::string(command_.reason);
  situation.foreseen = tracker_->prediction().foreseen();
  return situation;
}

scenario::MotionSample ClosedLoop::motion() const {
  const plant::Truth& truth = plant_.truth();
  scenario::MotionSample sample;
  sample.t_s = truth.stamp_s;
  sample.state = truth.planar;
  sample.roll_rad = truth.roll_rad;
  sample.pitch_rad = truth.pitch_rad;
  sample.thrusts_n = truth.thrusts_n;
  sample.clearance_m = plant_.clearance();
  const trajectory::TimedTrajectory& sailed = supervisor_->sailed();
  if (!sailed.trajectory.empty()) {
    sample.reference =
        sailed.trajectory.sample(sailed.elapsed(time()), options_.vessel).state.head<3>();
  }
  return sample;
}

scenario::Progress ClosedLoop::progress() const {
  const scenario::MotionSample now = motion();
  scenario::Progress progress;
  progress.t_s = now.t_s;
  progress.speed_mps = vessel::speedOf(now.state);
  progress.clearance_m = now.clearance_m;
  progress.tracking_error_m = command_.tracking_error_m;
  progress.state = mission::name(supervisor_->phase());
  progress.detail = supervisor_->reason();
  const trajectory::TimedTrajectory& sailed = supervisor_->sailed();
  progress.distance_left_m =
      sailed.trajectory.empty()
          ? (now.state.head<2>() - goal_.position).norm()
          : trajectory::length(stopping::remainder(sailed.trajectory, sailed.elapsed(time())));
  return progress;
}

scenario::MissionResult ClosedLoop::result(const scenario::MissionLabel& label) const {
  const mission::Replans replans = supervisor_->replans();
  scenario::MissionResult result =
      recorder_.result(label, outcome_.value_or(scenario::Outcome::kTimeout), reason_, replans.all);
  result.replans_for_weather = replans.for_weather;
  return result;
}

void ClosedLoop::finish(scenario::Outcome outcome, std::string reason) {
  outcome_ = outcome;
  reason_ = std::move(reason);
}

}  // namespace otter_nav::simulation
