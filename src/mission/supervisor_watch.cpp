// What the supervisor does while the vessel is under way: watches the way ahead, brakes, settles.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/stopping/back_off.hpp"
#include "otter_nav/stopping/braking.hpp"

namespace otter_nav::mission {
namespace {

constexpr double kAtRestMps = 0.2;
constexpr double kAtRestRadps = 0.1;

bool atRest(const vessel::State& state) {
  return state.segment<2>(vessel::kSurge).norm() < kAtRestMps &&
         std::abs(state[vessel::kYawRate]) < kAtRestRadps;
}

std::string conflictText(const stopping::Conflict& conflict) {
  char text[128];
  std::snprintf(text, sizeof(text), "only %.2f m clear at (%.1f m, %.1f m) on the way",
                conflict.clearance_m, conflict.position.x(), conflict.position.y());
  return text;
}

}  // namespace

std::string Supervisor::faultOf(double now_s, const Situation& situation) const {
  if (situation.tracker_fault) {
    return "the tracker stops: " + situation.tracker_reason;
  }
  if (!situation.state.allFinite()) {
    return "odometry is not finite";
  }
  if (now_s - situation.odometry_stamp_s > options_.odometry_timeout_s) {
    return "no odometry";
  }
  return {};
}

Orders Supervisor::watchTheWay(double now_s, const Situation& situation,
                               const map::DistanceField& field) {
  if (std::string fault = faultOf(now_s, situation); !fault.empty()) {
    return stopByItself(now_s, std::move(fault));
  }
  const double left = timeLeft(now_s);
  if (left <= 0.0) {
    return settle(now_s, situation);
  }
  const double at = now_s - sailed_.start_time_s;
  const double least = options_.critical_clearance_m;
  const double slack = options_.clearance_slack_m;
  const stopping::Conflict ahead = stopping::firstConflict(
      sailed_.trajectory, at, field, std::max(least, sailed_clearance_m_ - slack));
  if (ahead.found) {
    if (phase_ == Phase::kSailing) {
      enter(Phase::kReplanning, conflictText(ahead));
      for_clearance_ = true;
    }
    const stopping::Conflict blocking =
        stopping::firstConflict(sailed_.trajectory, at, field, least);
    if (blocking.found && blocking.time_s - at < options_.brake_horizon_s &&
        mustBrake(now_s, field)) {
      return brake(now_s, field, conflictText(blocking));
    }
  } else if (phase_ == Phase::kReplanning && for_clearance_) {
    pending_.reset();
    enter(Phase::kSailing);
  }
  return replanIfNeeded(now_s, situation, field);
}

Orders Supervisor::replanIfNeeded(double now_s, const Situation& situation,
                                  const map::DistanceField& field) {
  if (pending_ || now_s < not_before_s_) {
    return {};
  }
  if (situation.tracking_error_m > options_.tracking_error_max_m) {
    enter(Phase::kReplanning, "far off the trajectory");
    for_clearance_ = false;
    ++times_left_behind_;
    return requestFromVessel(now_s, situation, field);
  }
  constexpr double kTooMuch = 0.1;  // of the limits
  constexpr double kAgainS = 3.0;
  if (sailed_thrust_share_ > freeThrustShare() + kTooMuch + 1e-9 &&
      (replans_ == 0 || now_s - plan_time_s_ >= kAgainS)) {
    enter(Phase::kReplanning, "wind and current take thrust that the plan counts on");
    for_clearance_ = false;
    return requestFromVessel(now_s, situation, field);
  }
  if (phase_ == Phase::kReplanning) {
    return requestFromSailed(now_s, field);
  }
  const double period = options_.improve_period_s;
  if (period > 0.0 && now_s - plan_time_s_ >= period && timeLeft(now_s) > period) {
    plan_time_s_ = now_s;
    Orders orders = requestFromSailed(now_s, field);
    if (pending_) {
      pending_->improves = true;
    }
    return orders;
  }
  return {};
}

bool Supervisor::mustBrake(double now_s, const map::DistanceField& field) const {
  const double later = now_s - sailed_.start_time_s + options_.stop_reserve_s;
  const stopping::BrakingOptions braking{options_.brake_thrust_share,
                                         options_.margins.plan_clearances_m.back()};
  return !stopping::brakingTrajectory(sailed_.trajectory, later, field, vessel_, braking).clear;
}

Orders Supervisor::brake(double now_s, const map::DistanceField& field, std::string reason) {
  const stopping::BrakingOptions braking{options_.brake_thrust_share,
                                         options_.margins.plan_clearances_m.back()};
  stopping::Braking stop = stopping::brakingTrajectory(
      sailed_.trajectory, now_s - sailed_.start_time_s, field, vessel_, braking);
  if (stop.trajectory.empty()) {
    return stopByItself(now_s, std::move(reason));
  }
  pending_.reset();
  phase_time_s_ = now_s;
  enter(Phase::kStopping, std::move(reason));
  sailed_ = {std::move(stop.trajectory), now_s};
  Orders orders;
  orders.sail = sailed_;
  return orders;
}

Orders Supervisor::stopByItself(double now_s, std::string reason) {
  pending_.reset();
  phase_time_s_ = now_s;
  enter(Phase::kStopping, std::move(reason));
  sailed_ = {};
  Orders orders;
  orders.stop = true;
  return orders;
}

// What was free when it set off may not be any more: the water astern is the less known.
Orders Supervisor::watchBackingOff(double now_s, const Situation& situation,
                                   const map::DistanceField& field) {
  if (std::string fault = faultOf(now_s, situation); !fault.empty()) {
    return stopByItself(now_s, std::move(fault));
  }
  constexpr double kTouchesM = 0.05;  // half of what it set off with
  const double at = now_s - sailed_.start_time_s;
  if (at < sailed_.trajectory.duration() &&
      !stopping::outlineKeepsClear(sailed_.trajectory, at, vessel_, field, kTouchesM)) {
    return stopByItself(now_s, "something came up where the vessel backs off to");
  }
  return watchTheStop(now_s, situation);
}

Orders Supervisor::watchTheStop(double now_s, const Situation& situation) {
  constexpr double kPatienceS = 15.0;
  const bool over = sailed_.trajectory.empty() || timeLeft(now_s) <= 0.0;
  const bool known = situation.state.allFinite() &&
                     now_s - situation.odometry_stamp_s <= options_.odometry_timeout_s;
  if (!over || (!(known && atRest(situation.state)) && now_s - phase_time_s_ < kPatienceS)) {
    return {};
  }
  if (after_stop_) {
    enter(*after_stop_, reason_);
    after_stop_.reset();
    return {};
  }
  if (!known) {
    enter(Phase::kFailed, reason_);
    return {};
  }
  ++stops_;
  if (stops_ > options_.stops_max) {
    enter(Phase::kFailed, "stopped " + std::to_string(stops_) + " times, the last: " + reason_);
    return {};
  }
  rung_ = 0;
  rounds_ = 0;
  not_before_s_ = now_s;
  enter(Phase::kStopped, reason_);
  return {};
}

Orders Supervisor::settle(double now_s, const Situation& situation) {
  if (arrived(situation)) {
    enter(Phase::kArrived);
    return {};
  }
  // A trajectory that ends elsewhere belongs to a goal that was replaced: nothing to wait for.
  constexpr double kElsewhereM = 0.5;
  const trajectory::Trajectory& way = sailed_.trajectory;
  const bool elsewhere =
      (way.flat(way.duration()).position - goal_.position).norm() > kElsewhereM &&
      atRest(situation.state);
  if (-timeLeft(now_s) < options_.settle_s && !elsewhere) {
    return {};
  }
  char why[128];
  std::snprintf(why, sizeof(why), "not settled: %.2f m from the goal at the trajectory's end",
                (situation.state.head<2>() - goal_.position).norm());
  ++stops_;
  if (stops_ > options_.stops_max) {
    enter(Phase::kFailed, why);
    return {};
  }
  pending_.reset();
  rung_ = 0;
  rounds_ = 0;
  not_before_s_ = now_s;
  enter(Phase::kStopped, why);
  return {};
}

}  // namespace otter_nav::mission
