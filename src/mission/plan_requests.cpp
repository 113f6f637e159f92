#include "plan_requests.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "otter_nav/base/parts.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/feasibility/clearance_walk.hpp"
#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/stopping/splice.hpp"
#include "otter_nav/trajectory/joint.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::mission {
namespace {

// From `at_s` on, the first time at which a new trajectory can begin: well under way, and with a
// heading that follows from the path. A plan that starts at walking pace has a heading that hardly
// counts and turns at once. Nothing where it isn't `fastest_mps` at most by `slow_by_s`.
std::optional<double> joiningTime(const trajectory::TimedTrajectory& whole, double at_s,
                                  double fastest_mps, double slow_by_s) {
  constexpr double kStepS = 0.1;
  const double least = PlanRequests::joiningSpeed(whole);
  const trajectory::Trajectory& sailed = whole.trajectory;
  const int steps = partsOf(sailed.duration() - at_s, kStepS, 0);
  for (int k = 0; k < steps; ++k) {
    const double t = at_s + k * kStepS;
    const trajectory::Piece& piece = sailed.pieces()[sailed.pieceAt(t)];
    const double speed_mps = sailed.flat(t).velocity.norm();
    if (piece.kind == trajectory::PieceKind::kSpin || speed_mps < least) {
      continue;
    }
    if (speed_mps <= fastest_mps) {
      return t;
    }
    if (t >= slow_by_s) {
      break;
    }
  }
  return std::nullopt;
}

// From `at_s` on, the first time before the end at which the vessel rests on its way.
std::optional<double> restingTime(const trajectory::Trajectory& sailed, double at_s) {
  for (std::size_t k = sailed.pieceAt(at_s); k + 1 < sailed.pieces().size(); ++k) {
    const trajectory::Piece& piece = sailed.pieces()[k];
    if (sailed.startOf(k + 1) >= at_s && piece.kind == trajectory::PieceKind::kSpin &&
        trajectory::endsAtRest(piece)) {
      return sailed.startOf(k + 1);
    }
  }
  return std::nullopt;
}

// Of the hull's centre where the plan begins and ends, m.
double roomAtEnds(const map::DistanceField& field, const Eigen::Vector2d& start,
                  const Eigen::Vector2d& goal) {
  return std::min(field.clearance(start), field.clearance(goal));
}

// What the discs that cover the hull leave where it lies, m.
double roomAround(const vessel::Hull& hull, const trajectory::Boundary& at,
                  const map::DistanceField& field) {
  constexpr double kNoCentreM = -1e3;  // the discs alone
  const Eigen::Vector2d bow = unitVector(at.psi_rad);
  double centre = 0.0;
  return feasibility::HullCover(hull).slack(
      field, at.flat.position, 0.0, kNoCentreM, [&] { return bow; }, centre);
}

// Whether a part of the water near `place` is known to nobody.
bool isUnknownNear(const Eigen::Vector2d& place, const feasibility::Obstacles& obstacles) {
  constexpr double kNearM = 8.0;
  constexpr double kStepM = 0.5;
  constexpr int kSteps = static_cast<int>(kNearM / kStepM);
  constexpr int kFew = 8;  // of about 800 places
  const map::DistanceField& known = obstacles.inKnownWater().field();
  int unknown = 0;
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      const Eigen::Vector2d off = kStepM * Eigen::Vector2d(i, j);
      unknown += off.norm() <= kNearM && known.clearance(place + off) <= 0.0 &&
                         obstacles.field().clearance(place + off) > 0.0
                     ? 1
                     : 0;
    }
  }
  return unknown > kFew;
}

}  // namespace

PlanRequests::PlanRequests(const SupervisorOptions& options, const vessel::Parameters& vessel,
                           std::uint64_t seed)
    : safety(options, vessel), latency(options.planning_latency_s), vessel_(vessel), seed_(seed) {}

PlanRequest PlanRequests::fromRest(double now_s, const vessel::State& state,
                                   const vessel::Pose& goal,
                                   const feasibility::Obstacles& obstacles) {
  PlanRequest request;
  request.query.start.flat.position = state.head<2>();
  // Nearly bow to the load, where waves swing it.
  const double turn_rad = safety.turnIntoLoad(state[vessel::kPsi]);
  request.query.start.psi_rad =
      state[vessel::kPsi] + (std::abs(turn_rad) < kIntoLoadRad ? turn_rad : 0.0);
  request.start_time_s = now_s + latency.seconds();
  request.query.may_creep = safety.mayCreep();
  return ask(now_s, std::move(request), goal, safety.nextThrustShare(), From::kRest, obstacles);
}

std::optional<PlanRequest> PlanRequests::fromSailed(double now_s,
                                                    const trajectory::TimedTrajectory& sailed,
                                                    double thrust_share, const vessel::Pose& goal,
                                                    const feasibility::Obstacles& obstacles,
                                                    double rests_by_s) {
  // Where it begins says which level there is room for, and that how fast it may begin.
  std::optional<double> at;
  do {
    at = beginning(now_s, sailed, rests_by_s, safety.fastestStart(safety.level()));
    if (!at) {
      return std::nullopt;
    }
  } while (safety.narrowTo(
      roomAtEnds(obstacles.field(), sailed.trajectory.flat(*at).position, goal.position)));
  const trajectory::Sample sample =
      trajectory::MotionAlong(sailed.trajectory, vessel_, safety.planDisturbance()).sample(*at);
  PlanRequest request;
  request.query.start.flat = sample.flat;
  request.query.start.psi_rad = sample.state[vessel::kPsi];
  request.start_time_s = sailed.start_time_s + *at;
  // One that leads elsewhere helps nobody.
  constexpr double kSameGoalM = 0.5;
  const trajectory::Trajectory& path = sailed.trajectory;
  if ((path.flat(path.duration()).position - goal.position).norm() < kSameGoalM) {
    request.query.warm_start = stopping::remainder(path, *at);
  }
  constexpr double kStartMargin = 1.05;
  // The force it begins with is one of the plan being sailed, made in the weather of then.
  const double least = kStartMargin * vessel::shareOfLimit(sample.thrusts, vessel_.thrusters) /
                       feasibility::SafetyLimits::of(vessel_, 0.0).thrust_share;
  return ask(now_s, std::move(request), goal, std::max(thrust_share, std::min(least, 1.0)),
             From::kSailed, obstacles);
}

double PlanRequests::joiningSpeed(const trajectory::TimedTrajectory& sailed) {
  constexpr double kLeastSpeedMps = 0.4;
  constexpr double kLeastSpeedShare = 0.4;  // of the speed limit, where that is less
  return std::min(kLeastSpeedMps, kLeastSpeedShare * sailed.speed_max_mps);
}

std::optional<double> PlanRequests::beginning(double now_s,
                                              const trajectory::TimedTrajectory& sailed,
                                              double rests_by_s, double fastest_mps) const {
  constexpr double kSlowsDownS = 6.0;  // as a stop does
  const double soon = sailed.elapsed(now_s + latency.seconds());
  const double slow_by_s = std::min(soon + kSlowsDownS, sailed.elapsed(rests_by_s));
  if (const std::optional<double> at = joiningTime(sailed, soon, fastest_mps, slow_by_s)) {
    return at;
  }
  const std::optional<double> at = restingTime(sailed.trajectory, soon);
  return at && sailed.start_time_s + *at <= rests_by_s ? at : std::nullopt;
}

std::optional<double> PlanRequests::joint(double now_s,
                                          const trajectory::TimedTrajectory& sailed) const {
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  const std::optional<double> at =
      joiningTime(sailed, sailed.elapsed(now_s + latency.seconds()), kUnbounded, kUnbounded);
  return at ? std::optional<double>(sailed.start_time_s + *at) : std::nullopt;
}

PlanRequest PlanRequests::onward(double now_s, trajectory::TimedTrajectory lead,
                                 double thrust_share, double sailed_mps, const vessel::Pose& goal,
                                 const feasibility::Obstacles& obstacles) {
  const trajectory::Sample sample =
      trajectory::MotionAlong(lead.trajectory, vessel_, {}).sample(lead.trajectory.duration());
  PlanRequest request;
  request.query.start.flat = sample.flat;
  request.query.start.psi_rad = sample.state[vessel::kPsi];
  request.start_time_s = lead.start_time_s + lead.trajectory.duration();
  request = ask(now_s, std::move(request), goal, thrust_share, From::kSailed, obstacles);
  // Others are no reason to sail slower than went well so far.
  double& speed_max_mps = request.query.limits.speed_max_mps;
  speed_max_mps =
      std::max(speed_max_mps, std::min({sailed_mps, asked_->catch_up_mps, safety.speedInWaves(),
                                        safety.sailingSpeed(sailed_mps)}));
  asked_->request = request;
  asked_->lead = std::move(lead);
  return request;
}

bool PlanRequests::mayBeFaster(std::size_t level, double pace_share, const vessel::State& state,
                               const feasibility::Obstacles& obstacles) {
  constexpr double kMarkedly = 1.25;
  if (pace_share >= 1.0) {
    return false;
  }
  safety.inUnknownWater(isUnknownNear(state.head<2>(), obstacles));
  return paceShare(level) > kMarkedly * pace_share;
}

double PlanRequests::paceShare(std::size_t level) const {
  feasibility::SafetyLimits usual = feasibility::SafetyLimits::of(vessel_, 0.0);
  usual.limitSpeed(safety.speedMax());
  return safety.paceAt(level, usual.speed_max_mps) / usual.speed_max_mps;
}

PlanRequest PlanRequests::fromVessel(double now_s, const vessel::State& state,
                                     const vessel::Pose& goal,
                                     const feasibility::Obstacles& obstacles) {
  constexpr double kStartShare = 0.9;  // of the plan's thrust, at its beginning
  const double share = safety.nextThrustShare();
  PlanRequest request;
  request.query.start.flat =
      vessel::pathFromState(state, kStartShare * share * 2.0 * vessel_.thrusters.ahead_max_n,
                            vessel_, safety.planDisturbance());
  request.query.start.flat.position += latency.seconds() * request.query.start.flat.velocity;
  // One that has hardly got under way is better launched again than led on from next to nothing;
  // and going astern it doesn't point where a path from there would have it.
  constexpr double kHardlyMovingMps = 0.25;
  constexpr double kHardlyTurningRadps = 0.2;
  const bool hardly = vessel::speedOf(state) < kHardlyMovingMps &&
                      std::abs(state[vessel::kYawRate]) < kHardlyTurningRadps;
  if (hardly || state[vessel::kSurge] <= 0.0) {
    const Eigen::Vector2d there = request.query.start.flat.position;
    request.query.start.flat = {};
    request.query.start.flat.position = there;
  }
  request.query.start.psi_rad = state[vessel::kPsi];
  request.start_time_s = now_s + latency.seconds();
  return ask(now_s, std::move(request), goal, share, From::kVessel, obstacles);
}

bool PlanRequests::knowsDeadEndAt(const Eigen::Vector2d& place) const {
  const double same_m = vessel_.hull.length_m;
  return std::any_of(dead_ends_.begin(), dead_ends_.end(),
                     [&](const Eigen::Vector2d& other) { return (other - place).norm() < same_m; });
}

PlanRequest PlanRequests::ask(double now_s, PlanRequest request, const vessel::Pose& goal,
                              double thrust_share, From from,
                              const feasibility::Obstacles& obstacles) {
  const map::DistanceField& field = obstacles.field();
  const double room = roomAtEnds(field, request.query.start.flat.position, goal.position);
  safety.inUnknownWater(isUnknownNear(request.query.start.flat.position, obstacles));
  request.id = next_id_++;
  request.query.goal.flat.position = goal.position;
  request.query.goal.psi_rad = safety.restHeading(goal.psi_rad);
  request.query.seed = seed_ + static_cast<std::uint64_t>(request.id);
  request.query.limits = safety.limits(thrust_share, room, from != From::kRest);
  request.query.may_end_early = safety.atNarrowest();
  request.query.dead_ends = dead_ends_;
  // A stop may have ended nearer to something than plans keep.
  const double around = std::min(roomAround(vessel_.hull, request.query.start, field),
                                 roomAround(vessel_.hull, request.query.goal, field));
  double& margin = request.query.limits.hull_margin_m;
  margin = std::clamp(around - 2.0 * feasibility::kLeastSlackM, 0.0, margin);
  // Thrust beyond what gusts and waves leave is for holding headings and making good what they
  // took, not for going faster.
  const double catch_up_mps = safety.limits(safety.calmThrustShare(), room).speed_max_mps;
  request.query.limits.speed_max_mps =
      std::min(request.query.limits.speed_max_mps,
               safety.limits(safety.freeThrustShare(), room).speed_max_mps);
  request.thrust_share = thrust_share;
  asked_ = Asked{};
  asked_->request = request;
  asked_->from = from;
  asked_->since_s = now_s;
  asked_->speed_max_mps = safety.speedMax();
  asked_->catch_up_mps = std::max(catch_up_mps, request.query.limits.speed_max_mps);
  asked_->slow = safety.slowShare() < 1.0;
  asked_->level = safety.level();
  asked_->steps_wider = safety.stepsWider();
  asked_->pace_share = paceShare(asked_->level);
  asked_->in_unknown_water = safety.isInUnknownWater();
  return request;
}

}  // namespace otter_nav::mission
