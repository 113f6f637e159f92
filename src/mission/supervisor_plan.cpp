// What the supervisor asks the planner, and what it does with the answer.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/stopping/back_off.hpp"
#include "otter_nav/stopping/splice.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"

namespace otter_nav::mission {
namespace {

constexpr double kAtRestMps = 1e-3;
// A plan that starts at walking pace has a heading that hardly counts and turns at once.
constexpr double kLeastSpeedMps = 0.4;

// From `at_s` on, the first time at which a new trajectory can begin: well under way, and with a
// heading that follows from the way.
std::optional<double> joiningTime(const trajectory::Trajectory& sailed, double at_s) {
  constexpr double kStepS = 0.1;
  const int steps = static_cast<int>(std::ceil((sailed.duration() - at_s) / kStepS));
  for (int k = 0; k < steps; ++k) {
    const double t = at_s + k * kStepS;
    const trajectory::Piece& piece = sailed.pieces()[sailed.pieceAt(t)];
    if (piece.kind != trajectory::PieceKind::kSpin &&
        sailed.flat(t).velocity.norm() >= kLeastSpeedMps) {
      return t;
    }
  }
  return std::nullopt;
}

}  // namespace

// Of the first rung from the present one on that start and goal have room for.
double Supervisor::chooseClearance(const PlanRequest& request, const map::DistanceField& field) {
  const double room =
      std::min(field.clearance(request.start.position), field.clearance(goal_.position));
  const std::vector<double>& rungs = options_.margins.plan_clearances_m;
  while (rung_ + 1 < rungs.size() && rungs[rung_] > room) {
    ++rung_;
  }
  return planClearance(options_.margins, rung_, disturbance_share_, request.thrust_share,
                       vessel_.hull, room);
}

double Supervisor::freeThrustShare() const {
  return planThrustShare(options_.margins, disturbance_share_, times_left_behind_);
}

Orders Supervisor::post(double now_s, PlanRequest request, From from,
                        const map::DistanceField& field) {
  request.id = next_id_++;
  request.goal = goal_;
  request.moving = from != From::kRest;
  request.clearance_m = chooseClearance(request, field);
  request.seed = seed_ + static_cast<std::uint64_t>(request.id);
  Orders orders;
  orders.plan = request;
  pending_ = Pending{std::move(request), from, now_s, false};
  return orders;
}

Orders Supervisor::requestFromRest(double now_s, const Situation& situation,
                                   const map::DistanceField& field) {
  PlanRequest request;
  request.start.position = situation.state.head<2>();
  request.start_psi_rad = situation.state[vessel::kPsi];
  request.start_time_s = now_s;
  request.thrust_share = freeThrustShare();
  return post(now_s, std::move(request), From::kRest, field);
}

Orders Supervisor::requestFromSailed(double now_s, const map::DistanceField& field) {
  const std::optional<double> at =
      joiningTime(sailed_.trajectory, now_s + latency_s_ - sailed_.start_time_s);
  if (!at) {
    return {};  // about to come to rest: what comes then is settle()'s or the brake's to decide
  }
  const trajectory::Sample sample = sailed_.trajectory.sample(*at, vessel_);
  PlanRequest request;
  request.start = sample.flat;
  request.start_psi_rad = sample.state[vessel::kPsi];
  if (request.start.velocity.norm() < kAtRestMps) {
    request.start = {};
    request.start.position = sample.flat.position;
  }
  request.start_time_s = sailed_.start_time_s + *at;
  // The force it begins with is one of the plan being sailed.
  request.thrust_share = sailed_thrust_share_;
  request.warm_start = stopping::remainder(sailed_.trajectory, *at);
  return post(now_s, std::move(request), From::kSailed, field);
}

Orders Supervisor::requestFromVessel(double now_s, const Situation& situation,
                                     const map::DistanceField& field) {
  constexpr double kStartShare = 0.9;  // of the plan's thrust, at its beginning
  PlanRequest request;
  // A vessel too fast for the thrust that plans should keep to gets one with more rather than none.
  request.thrust_share =
      std::min(options_.margins.thrust_share,
               freeThrustShare() + times_refused_ * options_.margins.thrust_share_step);
  request.start = vessel::InverseDynamics(vessel_).fromState(
      situation.state, kStartShare * request.thrust_share * 2.0 * vessel_.thrusters.ahead_max_n);
  request.start.position += latency_s_ * request.start.velocity;
  request.start_psi_rad = situation.state[vessel::kPsi];
  request.start_time_s = now_s + latency_s_;
  return post(now_s, std::move(request), From::kVessel, field);
}

Orders Supervisor::waitForPlan(double now_s, const Situation& situation,
                               const map::DistanceField& field) {
  if (pending_ || now_s < not_before_s_) {
    return {};
  }
  if (const std::string fault = faultOf(now_s, situation); !fault.empty()) {
    not_before_s_ = now_s + options_.retry_pause_s;
    if (++rounds_ >= options_.rounds_from_rest) {
      enter(Phase::kFailed, fault);
    }
    return {};
  }
  return requestFromRest(now_s, situation, field);
}

Orders Supervisor::planFinished(double now_s, const PlanReply& reply, const Situation& situation,
                                const map::DistanceField& field) {
  if (!pending_ || reply.id != pending_->request.id) {
    return {};
  }
  const Pending asked = std::move(*pending_);
  pending_.reset();
  if (!reply.solved || reply.trajectory.empty()) {
    return planFailed(now_s, reply.reason, asked, situation, field);
  }
  return asked.from == From::kRest ? takeFromRest(now_s, reply, asked, situation, field)
                                   : takeMoving(now_s, reply, asked, field);
}

Orders Supervisor::takeFromRest(double now_s, const PlanReply& reply, const Pending& asked,
                                const Situation& situation, const map::DistanceField& field) {
  constexpr double kDriftM = 0.7;
  if ((situation.state.head<2>() - asked.request.start.position).norm() > kDriftM) {
    return requestFromRest(now_s, situation, field);
  }
  replans_ += phase_ == Phase::kStopped ? 1 : 0;
  sail({reply.trajectory, now_s}, asked.request, now_s);
  return Orders{std::nullopt, sailed_, false};
}

Orders Supervisor::takeMoving(double now_s, const PlanReply& reply, const Pending& asked,
                              const map::DistanceField& field) {
  constexpr double kLateM = 0.3;
  constexpr double kLatencyMaxS = 2.0;
  const double late = now_s - asked.request.start_time_s;
  const Eigen::Vector2d there = sailed_.trajectory.flat(now_s - sailed_.start_time_s).position;
  if (late > 0.0 && (reply.trajectory.flat(late).position - there).norm() > kLateM) {
    latency_s_ = std::min(kLatencyMaxS, 1.5 * latency_s_ + late);
    return asked.improves ? Orders{} : requestFromSailed(now_s, field);
  }
  if (asked.improves &&
      late + reply.trajectory.duration() > (1.0 - options_.improve_share) * timeLeft(now_s)) {
    return {};
  }
  ++replans_;
  latency_s_ = options_.planning_latency_s;
  if (asked.from == From::kVessel) {
    sail({reply.trajectory, asked.request.start_time_s}, asked.request, now_s);
  } else {
    const double began = sailed_.start_time_s;
    stopping::Spliced way = stopping::splice(sailed_.trajectory, now_s - began,
                                             asked.request.start_time_s - began, reply.trajectory);
    sail({std::move(way.trajectory), began + way.start_s}, asked.request, now_s);
  }
  return Orders{std::nullopt, sailed_, false};
}

void Supervisor::sail(SailOrder order, const PlanRequest& request, double now_s) {
  sailed_ = std::move(order);
  sailed_clearance_m_ = request.clearance_m;
  sailed_thrust_share_ = request.thrust_share;
  plan_time_s_ = now_s;
  times_refused_ = 0;
  rung_ = 0;
  enter(Phase::kSailing);
}

Orders Supervisor::planFailed(double now_s, const std::string& why, const Pending& asked,
                              const Situation& situation, const map::DistanceField& field) {
  if (asked.improves) {
    return {};
  }
  const bool last = rung_ + 1 >= options_.margins.plan_clearances_m.size();
  rung_ = last ? 0 : rung_ + 1;
  if (asked.from == From::kVessel && last) {
    ++times_refused_;
  }
  if (asked.from != From::kRest) {
    return {};  // asked again at the next update, as long as there is room
  }
  if (last) {
    if (Orders orders = tryBackingOff(now_s, why, situation, field); orders.sail) {
      return orders;
    }
    not_before_s_ = now_s + options_.retry_pause_s;
    if (++rounds_ >= options_.rounds_from_rest) {
      char clearance[64];
      std::snprintf(clearance, sizeof(clearance), " (at %.2f m clearance)",
                    asked.request.clearance_m);
      enter(Phase::kFailed,
            "no plan after " + std::to_string(rounds_) + " rounds: " + why + clearance);
    }
  }
  return {};
}

Orders Supervisor::tryBackingOff(double now_s, const std::string& why, const Situation& situation,
                                 const map::DistanceField& field) {
  if (!faultOf(now_s, situation).empty()) {
    return {};
  }
  std::optional<trajectory::Trajectory> way =
      stopping::backOff(situation.state, field, vessel_, situation.disturbance_n);
  if (!way) {
    return {};
  }
  phase_time_s_ = now_s;
  sailed_ = {std::move(*way), now_s};
  enter(Phase::kBackingOff, "no room to turn: " + why);
  return Orders{std::nullopt, sailed_, false};
}

}  // namespace otter_nav::mission
