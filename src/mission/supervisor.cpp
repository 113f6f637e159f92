#include "otter_nav/mission/supervisor.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::mission {
namespace {

std::string text(const Goal& goal) {
  char buffer[128];
  std::snprintf(buffer, sizeof(buffer), "goal (%.2f m, %.2f m, %.3f rad)", goal.position.x(),
                goal.position.y(), goal.psi_rad);
  return buffer;
}

Status checkGoal(const Goal& goal, const map::DistanceField& field, double clearance_m) {
  if (!goal.position.allFinite() || !std::isfinite(goal.psi_rad)) {
    return failure(text(goal) + " is not finite");
  }
  const map::GridGeometry& map = field.geometry();
  if (!map.contains(goal.position)) {
    const Eigen::Vector2d far =
        map.origin + map.resolution_m * Eigen::Vector2d(map.width, map.height);
    char range[128];
    std::snprintf(range, sizeof(range), " is outside the map, x in [%.2f, %.2f], y in [%.2f, %.2f]",
                  map.origin.x(), far.x(), map.origin.y(), far.y());
    return failure(text(goal) + range);
  }
  const double clearance = field.clearance(goal.position);
  if (clearance <= 0.0) {
    return failure(text(goal) + " is inside an obstacle");
  }
  if (clearance < clearance_m) {
    char why[96];
    std::snprintf(why, sizeof(why), " is %.2f m from an obstacle, at least %.2f m are needed",
                  clearance, clearance_m);
    return failure(text(goal) + why);
  }
  return {};
}

bool moving(const Situation& situation) {
  constexpr double kMovingMps = 0.3;
  return situation.state.segment<2>(vessel::kSurge).norm() > kMovingMps;
}

}  // namespace

const char* name(Phase phase) {
  switch (phase) {
    case Phase::kIdle:
      return "idle";
    case Phase::kPlanning:
      return "planning";
    case Phase::kSailing:
      return "sailing";
    case Phase::kReplanning:
      return "replanning";
    case Phase::kStopping:
      return "stopping";
    case Phase::kStopped:
      return "stopped";
    case Phase::kBackingOff:
      return "backing off";
    case Phase::kArrived:
      return "arrived";
    case Phase::kFailed:
      return "failed";
  }
  return "unknown";
}

Supervisor::Supervisor(SupervisorOptions options, vessel::Parameters vessel, std::uint64_t seed)
    : options_(std::move(options)),
      vessel_(std::move(vessel)),
      seed_(seed),
      latency_s_(options_.planning_latency_s) {}

Result<Orders> Supervisor::setGoal(double now_s, const Goal& goal, const Situation& situation,
                                   const map::DistanceField& field) {
  if (const Status status = checkGoal(goal, field, options_.margins.plan_clearances_m.back());
      !status) {
    return failure(status.error().message);
  }
  goal_ = goal;
  disturbance_share_ = disturbanceShare(situation.disturbance_n, vessel_.thrusters);
  pending_.reset();
  after_stop_.reset();
  rounds_ = 0;
  replans_ = 0;
  stops_ = 0;
  times_left_behind_ = 0;
  times_refused_ = 0;
  not_before_s_ = now_s;
  latency_s_ = options_.planning_latency_s;
  if (phase_ == Phase::kSailing || phase_ == Phase::kReplanning) {
    enter(Phase::kReplanning, "new goal");
    for_clearance_ = false;
    return requestFromSailed(now_s, field);
  }
  if (phase_ == Phase::kStopping || phase_ == Phase::kBackingOff) {
    return Orders{};
  }
  if (moving(situation)) {
    return stopByItself(now_s, "under way without a plan");
  }
  enter(Phase::kPlanning);
  return requestFromRest(now_s, situation, field);
}

Orders Supervisor::cancel(double now_s, const Situation& situation,
                          const map::DistanceField& field) {
  pending_.reset();
  if (phase_ == Phase::kSailing || phase_ == Phase::kReplanning) {
    after_stop_ = Phase::kIdle;
    return brake(now_s, field, "cancelled");
  }
  if (phase_ == Phase::kStopping || phase_ == Phase::kBackingOff) {
    after_stop_ = Phase::kIdle;
    return {};
  }
  if (moving(situation)) {
    after_stop_ = Phase::kIdle;
    return stopByItself(now_s, "cancelled");
  }
  enter(Phase::kIdle, "cancelled");
  return {};
}

Orders Supervisor::update(double now_s, const Situation& situation,
                          const map::DistanceField& field) {
  disturbance_share_ = disturbanceShare(situation.disturbance_n, vessel_.thrusters);
  if (pending_ && now_s - pending_->since_s > options_.planning_timeout_s) {
    const Pending asked = std::move(*pending_);
    pending_.reset();
    return planFailed(now_s, "no answer from the planner", asked, situation, field);
  }
  switch (phase_) {
    case Phase::kPlanning:
    case Phase::kStopped:
      return waitForPlan(now_s, situation, field);
    case Phase::kSailing:
    case Phase::kReplanning:
      return watchTheWay(now_s, situation, field);
    case Phase::kStopping:
      return watchTheStop(now_s, situation);
    case Phase::kBackingOff:
      return watchBackingOff(now_s, situation, field);
    case Phase::kIdle:
    case Phase::kArrived:
    case Phase::kFailed:
      break;
  }
  return {};
}

bool Supervisor::arrived(const Situation& situation) const {
  const vessel::State& x = situation.state;
  return (x.head<2>() - goal_.position).norm() <= options_.arrival_distance_m &&
         std::abs(wrapAngle(x[vessel::kPsi] - goal_.psi_rad)) <= options_.arrival_heading_rad &&
         x.segment<2>(vessel::kSurge).norm() <= options_.arrival_speed_mps;
}

double Supervisor::timeLeft(double now_s) const {
  return sailed_.trajectory.duration() - (now_s - sailed_.start_time_s);
}

void Supervisor::enter(Phase phase, std::string reason) {
  phase_ = phase;
  reason_ = std::move(reason);
}

}  // namespace otter_nav::mission
