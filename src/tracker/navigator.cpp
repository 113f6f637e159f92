#include "tracker/navigator.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::tracker {
namespace {

constexpr double kSameTimeS = 1e-9;
// A step this far off the prediction is not believed until it has stayed for a while.
constexpr double kJumpM = 1.0;
constexpr double kJumpRad = 0.5;
constexpr double kBelieveJumpAfterS = 0.3;
// Currents, gusts and seas carry a hull faster than its thrusters do, and turn it: of that speed
// and rate, and besides.
constexpr double kImpossibleShare = 3.0;
constexpr double kImpossibleMps = 5.0;
constexpr double kImpossibleRadps = 3.0;
// The water that waves carry to and fro looks like a current at first: what the first seconds tell
// of one is steered by in proportion to how much of this has been felt.
constexpr double kCurrentComesS = 5.0;
// Under way, until the waves are told from the current; and how soon that is out of date at
// crawling pace, where a hull is left to swing with them.
constexpr double kSeawayAfterS = 4.0;
constexpr double kSeawayComesS = 2.0;
constexpr double kSeawayFades = 0.3;  // s a second

void blend(double share, const vessel::Disturbance& other, vessel::Disturbance& d) {
  d.force_n += share * (other.force_n - d.force_n);
  d.moment_nm += share * (other.moment_nm - d.moment_nm);
  d.wind_mps += share * (other.wind_mps - d.wind_mps);
  d.current_mps += share * (other.current_mps - d.current_mps);
}

// For what is sent as long as the model alone is steered by, from the last odometry on.
std::size_t historyOf(const Options& options) {
  const double s = options.odometry.latency_s + options.odometry.predict_through_s + kBlindS;
  return static_cast<std::size_t>(std::ceil(s / options.period_s)) + 2;
}

}  // namespace

Navigator::Navigator(const Options& options, const vessel::Parameters& vessel)
    : options_(options.odometry),
      period_s_(options.period_s),
      vessel_(vessel),
      impossible_mps_(kImpossibleMps + kImpossibleShare * vessel.top_speed_mps),
      impossible_radps_(
          kImpossibleRadps +
          kImpossibleShare *
              vessel::turnLaw(vessel, vessel::greatestMoment(vessel.thrusters)).r_full),
      estimator_(options.estimator, vessel),
      seaway_(options.estimator, vessel, Waves::kInTheWater),
      new_estimator_(estimator_),
      new_seaway_(seaway_),
      foresees_waves_(options.estimator.enabled && options.estimator.wave_velocity_mps > 0.0 &&
                      estimator_.estimatesCurrent()),
      sent_(historyOf(options)) {}

long Navigator::oldest() const {
  return std::max(0L, sent_count_ - static_cast<long>(sent_.size()));
}

const Navigator::Sent& Navigator::sent(long index) const {
  return sent_[static_cast<std::size_t>(index) % sent_.size()];
}

Navigator::Sent& Navigator::sent(long index) {
  return sent_[static_cast<std::size_t>(index) % sent_.size()];
}

void Navigator::addCommand(double stamp_s, const vessel::Thrusts& thrusts) {
  sent(sent_count_) = {stamp_s, thrusts};
  ++sent_count_;
}

void Navigator::replaceCommand(const vessel::Thrusts& thrusts) {
  if (sent_count_ > 0) {
    sent(sent_count_ - 1).thrusts = thrusts;
  }
}

long Navigator::sentBy(double time_s) const {
  long i = sent_count_ - 1;
  while (i >= oldest() && sent(i).stamp_s > time_s + kSameTimeS) {
    --i;
  }
  return i;
}

vessel::Thrusts Navigator::thrustsOf(long index) const {
  return index >= oldest() && index < sent_count_ ? sent(index).thrusts : vessel::Thrusts::Zero();
}

template <typename Step>
void Navigator::forEachPiece(double until_s, vessel::Thrusts& acting, Step step) const {
  double t = stamp_s_;
  long in_force = sentBy(t);
  while (t < until_s - kSameTimeS) {
    const double dt = std::min(period_s_, until_s - t);
    while (in_force + 1 < sent_count_ && sent(in_force + 1).stamp_s <= t + kSameTimeS) {
      ++in_force;
    }
    const vessel::Thrusts command = thrustsOf(in_force);
    const double lag = vessel_.thrusters.lag_s;
    const vessel::Thrusts before = acting;
    if (lag > 0.0) {
      acting = command + std::exp(-dt / lag) * (acting - command);
    } else {
      acting = command;
    }
    step(lag > 0.0 ? vessel::Thrusts(0.5 * (before + acting)) : acting, dt);
    t += dt;
  }
}

bool Navigator::possible(const vessel::State& state) const {
  return std::hypot(state[vessel::kSurge], state[vessel::kSway]) <= impossible_mps_ &&
         std::abs(state[vessel::kYawRate]) <= impossible_radps_;
}

bool Navigator::believable(double stamp_s, const vessel::State& state) {
  const vessel::State jump = estimator_.innovation(state);
  const bool jumps = jump.head<2>().norm() > kJumpM || std::abs(jump[vessel::kPsi]) > kJumpRad;
  if (!jumps) {
    jumping_ = false;
    return true;
  }
  if (!jumping_) {
    jumping_ = true;
    jump_since_s_ = stamp_s;
  }
  return stamp_s - jump_since_s_ >= kBelieveJumpAfterS;
}

void Navigator::reset(const vessel::State& measured) {
  vessel::State state = measured;
  double& psi = state[vessel::kPsi];
  const double before = estimator_.state()[vessel::kPsi];
  psi = before + wrapAngle(psi - before);
  estimator_.reset(state);
  seaway_.reset(state);
  under_way_s_ = 0.0;
  jumping_ = false;
}

bool Navigator::isFinite() const {
  return estimator_.state().allFinite() && (!foresees_waves_ || seaway_.state().allFinite());
}

void Navigator::beginAnew(const vessel::State& measured) {
  estimator_ = new_estimator_;
  seaway_ = new_seaway_;
  acting_ = thrustsOf(sentBy(stamp_s_));
  felt_s_ = 0.0;
  reset(measured);
}

void Navigator::weighCurrents(double since_s) {
  disturbance_ = estimator_.disturbance();
  felt_s_ = std::min(felt_s_ + since_s, kCurrentComesS);
  disturbance_.current_mps *= felt_s_ / kCurrentComesS;
  if (!foresees_waves_) {
    return;
  }
  const double gained = estimator_.sailingShare() > 0.0 ? since_s : -kSeawayFades * since_s;
  under_way_s_ = std::clamp(under_way_s_ + gained, 0.0, kSeawayAfterS + kSeawayComesS);
  seaway_share_ = std::max(0.0, (under_way_s_ - kSeawayAfterS) / kSeawayComesS);
  blend(seaway_share_, seaway_.disturbance(), disturbance_);
}

void Navigator::addOdometry(double stamp_s, const vessel::State& state) {
  if (!std::isfinite(stamp_s) || !state.allFinite()) {
    reason_ = "odometry is not finite";
    return;
  }
  if (!possible(state)) {
    reason_ = "odometry is too fast to be true";
    return;
  }
  const double stamp = stamp_s - options_.latency_s;
  if (!started_) {
    started_ = true;
    stamp_s_ = stamp;
    reset(state);
    reason_ = {};
    return;
  }
  if (stamp <= stamp_s_ && !ahead_) {
    reason_ = "odometry is out of order";
    return;
  }
  const bool gap = ahead_ || stamp - stamp_s_ > options_.predict_through_s;
  if (!gap) {
    forEachPiece(stamp, acting_, [&](const vessel::Thrusts& thrusts, double dt) {
      estimator_.predict(thrusts, dt);
      if (foresees_waves_) {
        seaway_.predict(thrusts, dt);
      }
    });
  }
  const double felt_s = gap ? 0.0 : std::max(0.0, stamp - stamp_s_);
  stamp_s_ = stamp;
  if (gap) {
    ahead_ = false;
    acting_ = thrustsOf(sentBy(stamp));
    reset(state);
  } else if (believable(stamp, state)) {
    if (jumping_) {
      reset(state);
    }
    estimator_.update(state);
    if (foresees_waves_) {
      seaway_.update(state);
    }
  } else {
    reason_ = "odometry jumps";
    return;
  }
  if (!isFinite()) {
    beginAnew(state);
  }
  weighCurrents(felt_s);
  reason_ = {};
}

Fix Navigator::fix(double now_s) const {
  if (!started_) {
    return Fix::kNone;
  }
  const double silent = silence(now_s);
  if (silent > options_.predict_through_s || isAhead(silent)) {
    return Fix::kLost;
  }
  return silent > 3.0 * period_s_ ? Fix::kBridging : Fix::kGood;
}

vessel::State Navigator::predict(double time_s) const {
  vessel::State x = estimator_.steered();
  x += seaway_share_ * (seaway_.steered() - x);
  vessel::Thrusts acting = acting_;
  const double until = std::min(time_s, stamp_s_ + kBlindS);
  double t = stamp_s_;
  forEachPiece(until, acting, [&](const vessel::Thrusts& thrusts, double dt) {
    const WaterMotion moved = water(t + 0.5 * dt);
    x = rk4Step(
        [&](double, const vessel::State& y) {
          return derivativeInWater(y, thrusts, vessel_, disturbance_, moved);
        },
        0.0, x, dt);
    t += dt;
  });
  return x;
}

WaterMotion Navigator::water(double time_s) const {
  if (seaway_share_ == 0.0) {
    return {};
  }
  WaterMotion water = seaway_.water().at(time_s - stamp_s_);
  water.velocity_mps *= seaway_share_;
  water.acceleration_mps2 *= seaway_share_;
  return water;
}

}  // namespace otter_nav::tracker
