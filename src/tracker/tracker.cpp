#include "otter_nav/tracker/tracker.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/thrusters.hpp"
#include "tracker/bow_guard.hpp"
#include "tracker/handover.hpp"
#include "tracker/navigator.hpp"
#include "tracker/predictive_controller.hpp"
#include "tracker/reference.hpp"
#include "tracker/station_keeper.hpp"
#include "tracker/trajectory_check.hpp"

namespace otter_nav::tracker {
namespace {

using Eigen::Vector2d;
using vessel::kPsi;
using vessel::kSurge;
using vessel::kSway;
using vessel::kYawRate;

constexpr double kStoppedMps = 0.2;
constexpr double kStoppedRadps = 0.2;
// Who has stopped in open water doesn't turn for less: waves take it there and back, and a launch
// begins better from a hull that lies still.
constexpr double kNotWorthTurningM = 0.1;
constexpr double kBrakingShare = 0.6;  // of the thrust astern: how far ahead a stop ends
// A reference farther from the vessel than this is approached along a curve, on which the offset
// shrinks at this mean speed.
constexpr double kJoinLengths = 1.5;
constexpr double kJoinSpeedMps = 0.7;
constexpr double kJoinSpeedShare = 0.3;    // of the speed limit, where that is less
constexpr double kSamePathLengths = 0.25;  // nearer, the plan in force starts the next one
constexpr double kHereM = 0.1;  // but not where the trajectory begins with the hull's motion
constexpr double kHereMps = 0.2;

// By nonlinear model predictive control.
class PredictiveTracker final : public Tracker {
 public:
  PredictiveTracker(const Options& options, const vessel::Parameters& vessel);

  Status setTrajectory(trajectory::TimedTrajectory sailed, std::uint32_t order) override;
  void addOdometry(double stamp_s, const vessel::State& state, double bow_up_rad) override;
  void requestStop(std::string_view reason, double start_s, std::uint32_t order) override;
  Status setNearObstacles(NearObstacles near, std::uint32_t number) override;
  void setWeights(const Weights& weights) override;
  Command step(double now_s) override;
  void replaceCommand(const vessel::Thrusts& sent) override;
  void prepare(double next_s) override;

  [[nodiscard]] const Prediction& prediction() const override { return controller_.prediction(); }
  [[nodiscard]] const Options& options() const override { return options_; }

 private:
  struct Assignment {
    trajectory::TimedTrajectory sailed;  // empty: stop
    std::string_view reason;
    std::uint32_t order = 0;
  };
  struct Surroundings {
    NearObstacles near;
    std::uint32_t number = 0;
  };
  struct Measurement {
    double stamp_s = 0.0;
    vessel::State state = vessel::State::Zero();
    double bow_up_rad = 0.0;
  };

  void takeOdometry(double now_s);
  void takeAssignment(double now_s, const vessel::State& state);
  void takeSurroundings(double now_s);
  void beginTracking(double now_s, const vessel::State& state);
  void beginStop(std::string_view reason, double now_s, const vessel::State& state);
  void beginHolding(double now_s, const vessel::State& state);
  // The spot where braking ends.
  void restAhead(double now_s, const vessel::State& state);
  void watchFix(Fix fix, double now_s, const vessel::State& state);

  // Each gives the thrusts of its mode.
  vessel::Thrusts track(double now_s, const vessel::State& state, Command& command);
  vessel::Thrusts hold(double now_s, const vessel::State& state, Command& command);
  vessel::Thrusts stop(double now_s, const vessel::State& state, Fix fix, Command& command);

  void finish(double now_s, const vessel::State& state, Command& command);
  [[nodiscard]] vessel::Thrusts slew(const vessel::Thrusts& wanted) const;
  // The same with the bow kept from rising or diving too far.
  [[nodiscard]] vessel::Thrusts onEvenKeel(const vessel::Thrusts& wanted) const;
  // In the other modes nothing is pushed, for whatever reason.
  [[nodiscard]] bool sails() const { return mode_ != Mode::kIdle && mode_ != Mode::kFault; }

  Options options_;
  vessel::Parameters vessel_;
  Handover<Assignment> incoming_;
  Handover<Surroundings> new_surroundings_;
  Handover<Weights> new_weights_;
  std::unique_ptr<Weights> weights_;
  Ring<Measurement, 256> odometry_;
  std::atomic<double> last_now_s_{0.0};

  std::unique_ptr<Assignment> waiting_;  // not yet due, or already over: see fresh_
  std::unique_ptr<Assignment> sailing_;
  bool fresh_ = false;                               // waiting_ is still to come
  std::unique_ptr<Surroundings> next_surroundings_;  // not yet due, or already over
  std::unique_ptr<Surroundings> surroundings_;
  bool are_to_come_ = false;  // next_surroundings_
  Navigator navigator_;
  ReferenceSource reference_source_;
  StationKeeper keeper_;
  PredictiveController controller_;
  BowGuard bow_;

  std::uint64_t cycle_ = 0;
  std::uint64_t odometry_taken_ = 0;
  double odometry_stamp_s_ = 0.0;
  std::uint32_t order_taken_ = 0;
  std::uint32_t near_taken_ = 0;

  Mode mode_ = Mode::kIdle;
  std::string_view stop_reason_;
  double lost_since_s_ = 0.0;
  bool lost_ = false;
  vessel::Thrusts last_thrusts_ = vessel::Thrusts::Zero();
};

PredictiveTracker::PredictiveTracker(const Options& options, const vessel::Parameters& vessel)
    : options_(options),
      vessel_(vessel),
      navigator_(options, vessel),
      reference_source_(options, vessel),
      keeper_(vessel),
      controller_(options, vessel) {}

Status PredictiveTracker::setTrajectory(trajectory::TimedTrajectory sailed, std::uint32_t order) {
  if (Status status = checkTrajectory(sailed.trajectory, vessel_.top_speed_mps); !status) {
    return status;
  }
  if (!std::isfinite(sailed.start_time_s)) {
    return failure("trajectory start time is not finite");
  }
  if (const double left_s = sailed.left(last_now_s_.load()); left_s < 0.0) {
    return failure("trajectory ended " + std::to_string(-left_s) + " s ago");
  }
  auto assignment = std::make_unique<Assignment>();
  assignment->sailed = std::move(sailed);
  assignment->order = order;
  if (vessel_.speed_max_mps > 0.0) {
    double& speed_max_mps = assignment->sailed.speed_max_mps;
    speed_max_mps = std::min(speed_max_mps, vessel_.speed_max_mps);
  }
  incoming_.give(std::move(assignment));
  return {};
}

void PredictiveTracker::requestStop(std::string_view reason, double start_s, std::uint32_t order) {
  auto assignment = std::make_unique<Assignment>();
  assignment->sailed.start_time_s = start_s;
  assignment->order = order;
  assignment->reason = reason;
  incoming_.give(std::move(assignment));
}

Status PredictiveTracker::setNearObstacles(NearObstacles near, std::uint32_t number) {
  if (near.points.size() > kMostNearObstacles) {
    return failure(std::to_string(near.points.size()) + " near obstacles are more than " +
                   std::to_string(kMostNearObstacles));
  }
  const bool finite = std::isfinite(near.start_s) &&
                      std::all_of(near.points.begin(), near.points.end(),
                                  [](const Vector2d& point) { return point.allFinite(); });
  if (!finite) {
    return failure("a near obstacle is not finite");
  }
  new_surroundings_.give(std::make_unique<Surroundings>(Surroundings{std::move(near), number}));
  return {};
}

void PredictiveTracker::setWeights(const Weights& weights) {
  new_weights_.give(std::make_unique<Weights>(weights));
}

void PredictiveTracker::addOdometry(double stamp_s, const vessel::State& state, double bow_up_rad) {
  odometry_.push({stamp_s, state, bow_up_rad});
}

void PredictiveTracker::takeOdometry(double now_s) {
  navigator_.forgetWhatIsAhead(now_s);
  Measurement m;
  while (odometry_.pop(m)) {
    navigator_.addOdometry(m.stamp_s, m.state);
    ++odometry_taken_;
    odometry_stamp_s_ = m.stamp_s;
    bow_.add(m.stamp_s, m.bow_up_rad);
  }
}

void PredictiveTracker::takeAssignment(double now_s, const vessel::State& state) {
  if (incoming_.take(waiting_)) {
    fresh_ = true;
    order_taken_ = waiting_->order;
  }
  if (!fresh_ || waiting_->sailed.start_time_s > now_s) {
    return;
  }
  // The one that ends stays in waiting_ until the next is taken; then the giver frees it.
  std::swap(waiting_, sailing_);
  fresh_ = false;
  if (sailing_->sailed.trajectory.empty()) {
    beginStop(sailing_->reason, now_s, state);
  } else {
    beginTracking(now_s, state);
  }
}

void PredictiveTracker::takeSurroundings(double now_s) {
  if (new_surroundings_.take(next_surroundings_)) {
    are_to_come_ = true;
    near_taken_ = next_surroundings_->number;
  }
  if (are_to_come_ && next_surroundings_->near.start_s <= now_s) {
    are_to_come_ = false;
    std::swap(next_surroundings_, surroundings_);  // the giver frees what is over
    controller_.keepOff(&surroundings_->near);
  }
}

void PredictiveTracker::beginTracking(double now_s, const vessel::State& state) {
  const bool under_way = mode_ == Mode::kTracking;
  mode_ = Mode::kTracking;
  stop_reason_ = {};
  reference_source_.start(sailing_->sailed, now_s);
  const vessel::FlatPoint z = reference_source_.flat(now_s);
  const Vector2d offset = state.head<2>() - z.position;
  const Vector2d velocity_offset = vessel::velocityOverGround(state) - z.velocity;
  if (offset.norm() > kJoinLengths * vessel_.hull.length_m) {
    reference_source_.join(
        now_s, offset, velocity_offset,
        std::max(4.0, offset.norm() / std::min(kJoinSpeedMps,
                                               kJoinSpeedShare * sailing_->sailed.speed_max_mps)));
  }
  // What is begun right from here is a motion of the hull and the best start for its plan; from the
  // plan in force the iteration may not come to one that leads elsewhere.
  const bool begins_here = offset.norm() < kHereM && velocity_offset.norm() < kHereMps;
  const bool same_path = offset.norm() < kSamePathLengths * vessel_.hull.length_m;
  controller_.start(under_way && same_path && !begins_here);
}

void PredictiveTracker::beginStop(std::string_view reason, double now_s,
                                  const vessel::State& state) {
  // Who holds a spot has stopped there: where the hull is right now may be the end of a swing.
  const bool holds_a_spot = mode_ == Mode::kHolding && keeper_.swingsAbout(state);
  if (mode_ != Mode::kStopped) {
    mode_ = Mode::kStopping;
    if (!holds_a_spot) {
      restAhead(now_s, state);
    }
  }
  stop_reason_ = reason;
}

void PredictiveTracker::restAhead(double now_s, const vessel::State& state) {
  const Vector2d velocity = vessel::velocityOverGround(state);
  const double braking_mps2 =
      kBrakingShare * 2.0 * vessel_.thrusters.astern_max_n / vessel_.manoeuvring.surge_inertia_kg;
  // Sooner rather than far away, should the speed be wrong.
  const double speed_mps = std::min(velocity.norm(), vessel_.top_speed_mps);
  const Vector2d ahead =
      braking_mps2 > 0.0
          ? (0.5 * speed_mps * speed_mps / braking_mps2 * velocity.stableNormalized()).eval()
          : Vector2d::Zero().eval();
  keeper_.start(state.head<2>() + ahead, state[kPsi], state[kPsi], now_s);
  controller_.start(false);
}

void PredictiveTracker::beginHolding(double now_s, const vessel::State& state) {
  mode_ = Mode::kHolding;
  const trajectory::Sample goal = reference_source_.at(reference_source_.end());
  // A path that alone says how the hull lies says nothing at rest but for the line: bow where it
  // was.
  constexpr double kBeforeS = 0.5;
  const double before = reference_source_.at(reference_source_.end() - kBeforeS).state[kPsi];
  const bool told = std::isinf(goal.heading_force_n);
  const bool turned = !told && std::cos(goal.state[kPsi] - before) < 0.0;
  keeper_.start(goal.state.head<2>(), goal.state[kPsi] + (turned ? kPi : 0.0), state[kPsi], now_s);
}

vessel::Thrusts PredictiveTracker::track(double now_s, const vessel::State& state,
                                         Command& command) {
  const auto thrusts =
      controller_.step(now_s, state, last_thrusts_, navigator_, reference_source_, command);
  if (thrusts) {
    return *thrusts;
  }
  beginStop("no usable plan", now_s, state);
  return keeper_.brake(state, navigator_.disturbance());
}

vessel::Thrusts PredictiveTracker::hold(double now_s, const vessel::State& state,
                                        Command& command) {
  const bool is_open = surroundings_ != nullptr && surroundings_->near.points.empty();
  reference_source_.rest(keeper_.position(), keeper_.heading(now_s, navigator_.disturbance()),
                         is_open && mode_ != Mode::kHolding ? kNotWorthTurningM : 0.0);
  const auto thrusts =
      controller_.step(now_s, state, last_thrusts_, navigator_, reference_source_, command);
  if (command.reason.empty() && keeper_.weathervaning()) {
    command.reason = "the heading yields to the position";
  }
  return thrusts ? *thrusts : keeper_.brake(state, navigator_.disturbance());
}

vessel::Thrusts PredictiveTracker::stop(double now_s, const vessel::State& state, Fix fix,
                                        Command& command) {
  const bool rests = std::hypot(state[kSurge], state[kSway]) < kStoppedMps &&
                     std::abs(state[kYawRate]) < kStoppedRadps;
  if (mode_ == Mode::kStopping && rests && fix != Fix::kLost) {
    mode_ = Mode::kStopped;
  }
  vessel::Thrusts thrusts = vessel::Thrusts::Zero();
  if (fix != Fix::kLost) {
    thrusts = hold(now_s, state, command);
  } else if (mode_ == Mode::kStopping) {
    thrusts = keeper_.brake(state, navigator_.disturbance());
  }
  command.reason = stop_reason_;
  return thrusts;
}

// Without odometry the model alone brakes the vessel; when that is too old to mean anything, the
// thrusters rest until odometry comes back, and the vessel then holds the spot it is found at.
void PredictiveTracker::watchFix(Fix fix, double now_s, const vessel::State& state) {
  if (fix != Fix::kLost) {
    if (mode_ == Mode::kFault || (lost_ && (mode_ == Mode::kStopping || mode_ == Mode::kStopped))) {
      mode_ = Mode::kStopped;
      restAhead(now_s, state);
    }
    lost_ = false;
    lost_since_s_ = now_s;
    return;
  }
  lost_ = true;
  lost_since_s_ = std::min(lost_since_s_, now_s);  // the clock may have been set back
  bow_.forget();
  if (mode_ == Mode::kTracking || mode_ == Mode::kHolding) {
    beginStop("odometry lost", now_s, state);
  }
  if (mode_ != Mode::kIdle && now_s - lost_since_s_ > kBlindS) {
    mode_ = Mode::kFault;
  }
}

vessel::Thrusts PredictiveTracker::slew(const vessel::Thrusts& wanted) const {
  const double most = options_.thrust_rate_nps * options_.period_s;
  const vessel::Thrusts change = (wanted - last_thrusts_).cwiseMax(-most).cwiseMin(most);
  return vessel::clampThrusts(last_thrusts_ + change, vessel_.thrusters);
}

// Cut before the slew, so that what turns the hull is slewed; after it, since the bow doesn't wait.
vessel::Thrusts PredictiveTracker::onEvenKeel(const vessel::Thrusts& wanted) const {
  const vessel::Thrusters& t = vessel_.thrusters;
  return bow_.cut(slew(bow_.cut(wanted, t)), t);
}

void PredictiveTracker::replaceCommand(const vessel::Thrusts& sent) {
  last_thrusts_ = sent;
  navigator_.replaceCommand(sent);
}

void PredictiveTracker::prepare(double next_s) {
  if (sails()) {
    controller_.prepare(next_s, last_thrusts_, navigator_, reference_source_);
  }
}

Command PredictiveTracker::step(double now_s) {
  const bool set_back = now_s < last_now_s_.exchange(now_s) - options_.odometry.predict_through_s;
  Command command;
  command.stamp_s = now_s;
  takeOdometry(now_s);
  if (new_weights_.take(weights_)) {
    controller_.setWeights(*weights_);
  }
  takeSurroundings(now_s);
  const Fix fix = navigator_.fix(now_s);
  const vessel::State state = navigator_.predict(now_s);
  if (fix != Fix::kNone) {
    takeAssignment(now_s, state);
  }
  watchFix(fix, now_s, state);
  // The way's beginning would be due once more, far behind the hull.
  if (set_back && (mode_ == Mode::kTracking || mode_ == Mode::kHolding)) {
    beginStop("the clock was set back", now_s, state);
  }
  if (mode_ == Mode::kTracking && now_s >= reference_source_.end()) {
    beginHolding(now_s, state);
  }
  if (mode_ == Mode::kTracking) {
    reference_source_.wait(now_s, state.head<2>());
  }
  vessel::Thrusts wanted = vessel::Thrusts::Zero();
  switch (mode_) {
    case Mode::kTracking:
      wanted = track(now_s, state, command);
      break;
    case Mode::kHolding:
      wanted = hold(now_s, state, command);
      break;
    case Mode::kStopping:
    case Mode::kStopped:
      wanted = stop(now_s, state, fix, command);
      break;
    case Mode::kFault:
      command.reason = "odometry lost";
      break;
    case Mode::kIdle:
      break;
  }
  command.thrusts = sails() ? onEvenKeel(wanted) : slew(wanted);
  finish(now_s, state, command);
  return command;
}

void PredictiveTracker::finish(double now_s, const vessel::State& state, Command& command) {
  if (!command.thrusts.allFinite()) {
    command.thrusts.setZero();
    command.reason = "a thrust was not finite";
  }
  last_thrusts_ = command.thrusts;
  navigator_.addCommand(now_s, command.thrusts);
  command.cycle = ++cycle_;
  command.odometry_taken = odometry_taken_;
  command.odometry_stamp_s = odometry_stamp_s_;
  command.order_taken = order_taken_;
  command.near_taken = near_taken_;
  command.weights = weights_ ? *weights_ : options_.flatness;
  command.mode = mode_;
  command.estimate = state;
  command.disturbance = navigator_.disturbanceEstimate();
  const double psi = state[kPsi];
  const vessel::OutsideLoad load =
      vessel::outsideLoad(psi, vessel_.manoeuvring, command.disturbance.mean);
  command.outside_force_n = Eigen::Rotation2Dd(psi) * Vector2d(load.surge_n, load.sway_n);
  command.outside_moment_nm = load.yaw_nm;
  if (command.reason.empty()) {
    command.reason = navigator_.reason();
  }
  if (mode_ == Mode::kTracking || mode_ == Mode::kHolding) {
    command.reference = reference_source_.at(now_s).state;
    const vessel::FlatPoint z = reference_source_.flat(now_s);
    command.reference.head<2>() = z.position;
    command.tracking_error_m = (state.head<2>() - z.position).norm();
    command.time_left_s = std::max(0.0, reference_source_.end() - now_s);
    command.at_goal = mode_ == Mode::kHolding && keeper_.holds(state);
  } else {
    command.reference = state;
  }
}

}  // namespace

std::string_view name(Mode mode) {
  switch (mode) {
    case Mode::kIdle:
      return "idle";
    case Mode::kTracking:
      return "tracking";
    case Mode::kHolding:
      return "holding";
    case Mode::kStopping:
      return "stopping";
    case Mode::kStopped:
      return "stopped";
    case Mode::kFault:
      return "fault";
  }
  return "unknown";
}

std::unique_ptr<Tracker> Tracker::create(const Options& options, const vessel::Parameters& vessel) {
  return std::make_unique<PredictiveTracker>(options, vessel);
}

}  // namespace otter_nav::tracker
