#include "weather.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "otter_nav/vessel/steady_motion.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::mission {
namespace {

using vessel::Disturbance;

constexpr double kKnownS = 1.0;     // the estimator's first transient has died down
constexpr double kMemoryS = 30.0;   // of the means
constexpr double kGapMostS = 5.0;   // that an estimate counts for: what was between nobody knows
constexpr double kFastestS = 60.0;  // the fastest gust fades out of memory
constexpr double kDeviations = 2.0;
constexpr double kPriorGust = 0.2;  // of the mean, while little was seen
constexpr double kNextS = 6.0;      // how long a gust may last
constexpr int kHeadings = 36;
constexpr double kThrustShare = 0.95;  // of the limits, that the mean may take
// Of the thrust: with less no heading follows from the path. A gust may have the hull astern by as
// much for a while.
constexpr double kAheadShare = 0.05;
constexpr double kNotHeld = 2.0;  // a turning share of what isn't possible at all

// A force `f` on a mass `m` with linear drag `d`, from rest, for `t` seconds: distance and speed.
struct Push {
  double distance_m, speed_mps;
};
Push push(double force_n, double mass_kg, double drag_kgps, double time_s) {
  const double memory = mass_kg / drag_kgps;
  const double decay = 1.0 - std::exp(-time_s / memory);
  const double steady = force_n / drag_kgps;
  return {steady * (time_s - memory * decay), steady * decay};
}

template <typename Visit>
void forEachHeading(Visit visit) {
  for (int k = 0; k < kHeadings; ++k) {
    visit(k * 2.0 * kPi / kHeadings);
  }
}

}  // namespace

void Weather::Spread::add(double value, double share, double fade) {
  const double off = value - mean;
  mean += share * off;
  variance = (1.0 - share) * (variance + share * off * off);
  most = std::max(std::abs(value), std::abs(mean) + fade * (most - std::abs(mean)));
}

double Weather::Spread::extreme(double prior) const {
  return std::max(
      {most, std::abs(mean) + kDeviations * std::sqrt(variance), (1.0 + prior) * std::abs(mean)});
}

void Weather::feel(double now_s, const Disturbance& estimate) {
  const double dt = started_ ? std::clamp(now_s - last_s_, 0.0, kGapMostS) : 0.0;
  last_s_ = now_s;
  felt_s_ += dt;
  if (!isKnown() || !started_) {  // no memory of the transient
    started_ = true;
    mean_ = estimate;
    wind_mps_ = {estimate.wind_mps.norm(), 0.0, 0.0};
    force_n_ = {estimate.force_n.norm(), 0.0, 0.0};
    moment_nm_ = {estimate.moment_nm, 0.0, 0.0};
    return;
  }
  // A plain mean until the memory is full, but for the second that the transient lasted.
  const double share = dt / std::min(kMemoryS, felt_s_ - 0.5 * kKnownS);
  const double fade = std::exp(-dt / kFastestS);
  const auto follow = [share](auto& mean, const auto& value) { mean += share * (value - mean); };
  follow(mean_.wind_mps, estimate.wind_mps);
  follow(mean_.force_n, estimate.force_n);
  follow(mean_.current_mps, estimate.current_mps);
  follow(mean_.moment_nm, estimate.moment_nm);
  wind_mps_.add(estimate.wind_mps.norm(), share, fade);
  force_n_.add(estimate.force_n.norm(), share, fade);
  moment_nm_.add(estimate.moment_nm, share, fade);
}

void Weather::feelSway(double now_s, double off_mps) {
  constexpr double kStepMostS = 0.5;  // of what happened between nothing is known
  const double dt = std::clamp(now_s - last_sway_s_, 0.0, kStepMostS);
  last_sway_s_ = now_s;
  sway_felt_s_ += dt;
  if (sway_felt_s_ > 0.0) {
    sway_off_mps_.add(off_mps, dt / std::min(kMemoryS, sway_felt_s_), std::exp(-dt / kFastestS));
  }
}

bool Weather::isKnown() const {
  return felt_s_ >= kKnownS;
}

bool Weather::mayTurnOutStrong() const {
  return felt_s_ < kMemoryS && isNearlyStrong();
}

bool Weather::rises() const {
  constexpr double kRisesS = 3.0;
  constexpr double kLightShare = 0.05;  // of both thrusters' force
  return felt_s_ < kRisesS && meanShare() > kLightShare;
}

Disturbance Weather::gust() const {
  return gust(kPriorGust);
}

Disturbance Weather::gust(double prior) const {
  prior *= std::max(0.0, 1.0 - felt_s_ / kMemoryS);
  const auto along = [](const Eigen::Vector2d& mean, double size) {
    const double norm = mean.norm();
    return norm > 0.0 ? (mean * (std::max(norm, size) / norm)).eval() : mean;
  };
  Disturbance gust = mean_;
  gust.wind_mps = along(mean_.wind_mps, wind_mps_.extreme(prior));
  gust.force_n = along(mean_.force_n, force_n_.extreme(prior));
  // It swings with each wave; the hull's inertia takes most of that.
  gust.moment_nm =
      std::copysign(std::abs(moment_nm_.mean) + std::sqrt(moment_nm_.variance), mean_.moment_nm);
  return gust;
}

double Weather::greatestMoment() const {
  double most = 0.0;
  forEachHeading([&](double psi) {
    most = std::max(most, std::abs(vessel::outsideLoad(psi, vessel_.manoeuvring, mean_).yaw_nm));
  });
  return most;
}

bool Weather::turnsWith(double share) const {
  return greatestMoment() > share * vessel::greatestMoment(vessel_.thrusters);
}

double Weather::meanShare() const {
  double most = 0.0;
  forEachHeading([&](double psi) {
    const vessel::Demand demand =
        vessel::demandOf(vessel_.manoeuvring, mean_, psi, 0.0, 0.0, Eigen::Vector2d::Zero(),
                         Eigen::Vector2d::Zero());
    most = std::max(most, std::hypot(demand.tau.surge_n, demand.sway_n));
  });
  return most / (2.0 * vessel_.thrusters.ahead_max_n);
}

double Weather::gustShare() const {
  const Disturbance hard = gust();
  const vessel::Thrusters& t = vessel_.thrusters;
  double most = 0.0;
  forEachHeading([&](double psi) {
    const vessel::OutsideLoad a = vessel::outsideLoad(psi, vessel_.manoeuvring, mean_);
    const vessel::OutsideLoad b = vessel::outsideLoad(psi, vessel_.manoeuvring, hard);
    const double each_n =
        0.5 * (std::abs(b.surge_n - a.surge_n) + std::abs(b.yaw_nm - a.yaw_nm) / t.lever_arm_m);
    most = std::max(most, each_n / t.ahead_max_n);
  });
  return std::min(1.0, most);
}

// With s the share that is left, the speed is s of the top speed and the moment
// munk * speed * sway; both thrusters share it.
double Weather::waveShare() const {
  const vessel::Thrusters& t = vessel_.thrusters;
  const double each_n = std::abs(vessel_.manoeuvring.munk_kg) * vessel_.top_speed_mps *
                        std::sqrt(sway_off_mps_.variance) / (2.0 * t.lever_arm_m);
  return each_n / (t.ahead_max_n + each_n);
}

bool Weather::knowsWaves() const {
  constexpr double kWaveS = 6.0;
  return sway_felt_s_ >= kWaveS;
}

double Weather::turningShare(const Eigen::Vector2d& velocity, const Disturbance& hard) const {
  const vessel::Thrusters& t = vessel_.thrusters;
  double least = kNotHeld;
  for (const vessel::SteadyMotion& motion :
       vessel::steadyHeadings(velocity, angleOf(velocity), vessel_, hard)) {
    if (motion.thrusts.sum() > -kAheadShare * 2.0 * t.ahead_max_n) {
      const double difference = motion.thrusts[vessel::kRight] - motion.thrusts[vessel::kLeft];
      least = std::min(least, std::abs(difference) * t.lever_arm_m / vessel::greatestMoment(t));
    }
  }
  return least;
}

bool Weather::hasThrustFor(const Eigen::Vector2d& velocity) const {
  const auto motions = vessel::steadyHeadings(velocity, angleOf(velocity), vessel_, mean_);
  return std::any_of(motions.begin(), motions.end(), [&](const auto& motion) {
    return motion.thrust_share <= kThrustShare &&
           motion.thrusts.sum() > kAheadShare * 2.0 * vessel_.thrusters.ahead_max_n;
  });
}

double Weather::sailingSpeed(double usual_mps) const {
  constexpr double kEnough = 0.7;    // of the thrusters' moment, for the gust
  constexpr double kSlowest = 0.12;  // of the top speed; slower, the hull hardly answers
  constexpr double kFastest = 0.8;
  constexpr double kStep = 0.04;
  constexpr double kWorth = 0.02;  // of the moment, for going slower
  constexpr int kCourses = 12;
  // Too slow at first costs seconds, too fast the heading.
  constexpr double kPriorForSpeed = 0.45;
  const Disturbance hard = gust(kPriorForSpeed);
  const auto velocityOn = [](int course, double speed) {
    return Eigen::Vector2d(speed * unitVector(course * 2.0 * kPi / kCourses));
  };
  const auto worst = [&](double speed) {
    double share = 0.0;
    for (int k = 0; k < kCourses; ++k) {
      share = std::max(share, turningShare(velocityOn(k, speed), hard));
    }
    return share;
  };
  const auto hasThrust = [&](double speed) {
    for (int k = 0; k < kCourses; ++k) {
      if (!hasThrustFor(velocityOn(k, speed))) {
        return false;
      }
    }
    return true;
  };
  const double usually = worst(usual_mps);
  if (usually <= kEnough) {
    return usual_mps;
  }
  // The fastest that leaves enough, else the one that leaves most.
  struct Choice {
    double share, speed;
    void consider(double other_share, double other_speed) {
      if (share > kEnough && (other_share <= kEnough || other_share < share - kWorth)) {
        *this = {other_share, other_speed};
      }
    }
  };
  // Where the mean leaves no thrust for some course at any speed, the headings alone count.
  Choice held{usually, usual_mps};
  Choice any = held;
  for (double at = kFastest; at >= kSlowest - 1e-9 && held.share > kEnough; at -= kStep) {
    const double speed = at * vessel_.top_speed_mps;
    if (speed < usual_mps) {
      const double share = worst(speed);
      any.consider(share, speed);
      if (hasThrust(speed)) {
        held.consider(share, speed);
      }
    }
  }
  return held.speed < usual_mps ? held.speed : any.speed;
}

// The gust's force beside the mean's comes all at once and lasts. The hull answers by turning
// towards it, with the moment that the gust leaves; until it has turned, all of the force sets it
// aside, and later what the thrust left over doesn't hold. Then it is brought back.
double Weather::gustReach() const {
  const Disturbance hard = gust();
  const vessel::ManoeuvringModel& m = vessel_.manoeuvring;
  const vessel::Thrusters& t = vessel_.thrusters;
  const double thrust_n = 2.0 * t.ahead_max_n;
  const double moment_nm = vessel::greatestMoment(t);
  double more_n = 0.0;  // than the mean's force, on the worst heading
  double most_n = 0.0;  // of the gust's
  double yaw_nm = 0.0;  // of the gust's
  forEachHeading([&](double psi) {
    const vessel::OutsideLoad a = vessel::outsideLoad(psi, m, mean_);
    const vessel::OutsideLoad b = vessel::outsideLoad(psi, m, hard);
    more_n = std::max(more_n, std::hypot(b.surge_n - a.surge_n, b.sway_n - a.sway_n));
    most_n = std::max(most_n, std::hypot(b.surge_n, b.sway_n));
    yaw_nm = std::max(yaw_nm, std::abs(b.yaw_nm));
  });
  if (!(more_n > 0.0)) {
    return 0.0;
  }
  const double turn_rad = std::atan2(more_n, std::max(most_n - more_n, 0.25 * thrust_n));
  const double left_nm = std::max(moment_nm - yaw_nm, 0.05 * moment_nm);
  // There and round again with all of the moment left, half the time each way.
  const double turn_s = std::min(kNextS, 2.0 * std::sqrt(turn_rad * m.yaw_inertia_kgm2 / left_nm));
  const double drag = vessel::steadyDrag(m.sway_drag_kgps, m.sway_drag_quadratic_kgpm, more_n);
  const Push at_first = push(more_n, m.sway_inertia_kg, drag, turn_s);
  const double rest_n = std::max(0.0, most_n - thrust_n);
  const Push later = push(std::min(rest_n, more_n), m.sway_inertia_kg, drag, kNextS - turn_s);
  return at_first.distance_m + at_first.speed_mps * m.sway_inertia_kg / drag + later.distance_m;
}

Eigen::Vector2d Weather::drift() const {
  const Disturbance hard = gust();
  constexpr double kRecoversS = 3.0;
  double fastest = 0.0;
  forEachHeading([&](double psi) {
    fastest = std::max(fastest, vessel::setAside(vessel_.manoeuvring, hard, psi));
  });
  const double bow = vessel::headingIntoLoad(vessel_.manoeuvring, mean_, 0.0);
  return -kRecoversS * fastest * unitVector(bow);
}

}  // namespace otter_nav::mission
