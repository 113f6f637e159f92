#include "optimizer/ends/end_manoeuvre.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "optimizer/ends/forced_motion.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kLeastTurnRad = 1e-3;
constexpr double kStraightLaunchS = 0.4;
constexpr double kLaunchShare = 0.95;     // of the full force, so that the way may turn at once
constexpr double kAheadShare = 0.5;       // of the full force, before that
constexpr double kDriftForceShare = 0.4;  // of full astern, at most, while turning at the goal
constexpr double kLongAgoS = -1e3;

struct Thrust {
  double ahead_n, astern_n;  // both thrusters together
  double lever_arm_m, lag_s, drag;

  Thrust(const vessel::Parameters& vessel, const ManoeuvreLimits& limits)
      : ahead_n(2.0 * limits.thrust_share * vessel.thrusters.ahead_max_n),
        astern_n(2.0 * limits.thrust_share * vessel.thrusters.astern_max_n),
        lever_arm_m(vessel.thrusters.lever_arm_m),
        lag_s(vessel.paper.m2_kgm2 / vessel.paper.d3_kgm2ps),
        drag(vessel.paper.d3_kgm2ps) {}

  // The moment over d3 that is left beside a surge force.
  [[nodiscard]] double turning(double surge_n) const {
    return lever_arm_m * std::min(ahead_n - surge_n, astern_n + surge_n) / drag;
  }
};

// What was computed turning left from heading zero, put where it belongs.
class Placed {
 public:
  Placed(double base_rad, bool left) : base_rad_(base_rad), side_(left ? 1.0 : -1.0) {
    matrix_ = Eigen::Rotation2D<double>(base_rad).toRotationMatrix();
    matrix_.col(1) *= side_;
  }

  [[nodiscard]] trajectory::Piece piece(const trajectory::Piece& local,
                                        const Eigen::Vector2d& offset) const {
    trajectory::Piece piece = local;
    piece.position = matrix_ * local.position;
    piece.position.col(0) += offset;
    piece.heading *= side_;
    piece.heading[0] += base_rad_;
    return piece;
  }

  [[nodiscard]] vessel::FlatPoint point(const vessel::FlatPoint& local,
                                        const Eigen::Vector2d& offset) const {
    vessel::FlatPoint z;
    z.position = matrix_ * local.position + offset;
    z.velocity = matrix_ * local.velocity;
    z.acceleration = matrix_ * local.acceleration;
    z.jerk = matrix_ * local.jerk;
    return z;
  }

 private:
  double base_rad_;
  double side_;
  Eigen::Matrix2d matrix_;
};

// A forced motion followed backward from rest at the origin, joint by joint.
class BackwardMotion {
 public:
  BackwardMotion(const ForcedMotion& forced, double end_s)
      : forced_(forced), times_{end_s}, motions_{{}} {}

  [[nodiscard]] const ForcedMotion::Motion& motion() const { return motions_.back(); }

  void reach(double t_s) {
    const std::vector<double> joints = forced_.joints(t_s, times_.back());
    for (std::size_t k = joints.size() - 1; k > 0; --k) {
      motions_.push_back(forced_.integrate(motions_.back(), joints[k], joints[k - 1]));
      times_.push_back(joints[k - 1]);
    }
  }

  void append(const Placed& placed, const Eigen::Vector2d& offset,
              std::vector<trajectory::Piece>& pieces) const {
    for (std::size_t k = times_.size() - 1; k > 0; --k) {
      pieces.push_back(placed.piece(
          forced_.piece(motions_[k], times_[k], motions_[k - 1], times_[k - 1]), offset));
    }
  }

 private:
  const ForcedMotion& forced_;
  std::vector<double> times_;
  std::vector<ForcedMotion::Motion> motions_;
};

// The astern force under which a drift ends just with the turn.
double driftForce(double turn_rad, const vessel::Parameters& vessel, const ManoeuvreLimits& limits,
                  const Thrust& thrust) {
  constexpr int kRounds = 4;
  const double lag = vessel.paper.m1_kg / vessel.paper.d1_kgps;
  const double most = kDriftForceShare * thrust.astern_n;
  double force = 0.0;
  for (int i = 0; i < kRounds && limits.drift_mps > 0.0; ++i) {
    const double lasts = turnToRest(turn_rad, thrust.turning(-force), limits.yaw_rate_max_radps,
                                    thrust.lag_s, limits.ramp_s)
                             .end();
    force = std::min(most, vessel.paper.d1_kgps * limits.drift_mps / std::expm1(lasts / lag));
  }
  return force;
}

}  // namespace

Manoeuvre launch(const Eigen::Vector2d& position, double psi_rad, double turn_rad,
                 const vessel::Parameters& vessel, const ManoeuvreLimits& limits) {
  const Thrust thrust(vessel, limits);
  std::optional<TurnProfile> turn;
  const double most = kLaunchShare * thrust.ahead_n;
  SurgeRamp ramp{kLongAgoS, kLongAgoS, most, most};
  double end = kStraightLaunchS;
  if (std::abs(turn_rad) > kLeastTurnRad) {
    const double r_full = thrust.turning(0.0);
    double ahead_s = 0.0;
    if (limits.settle) {
      turn = turnToRest(std::abs(turn_rad), r_full, limits.yaw_rate_max_radps, thrust.lag_s,
                        limits.ramp_s);
      ahead_s = turn->end();
    } else {
      const double brake = 0.5 * r_full / thrust.lag_s;
      LooseTurn loose = turnLoose(std::abs(turn_rad), r_full, limits.yaw_rate_max_radps,
                                  thrust.lag_s, limits.ramp_s, brake);
      turn = std::move(loose.profile);
      ahead_s = loose.moment_ends_s;
    }
    ramp = {ahead_s, ahead_s + limits.surge_ramp_s, 0.0, most};
    end = ramp.to_s;
  }
  const ForcedMotion forced(vessel, turn ? &*turn : nullptr, {ramp});
  const Placed placed(psi_rad, turn_rad >= 0.0);
  Manoeuvre manoeuvre;
  manoeuvre.duration_s = end;
  ForcedMotion::Motion motion;
  const std::vector<double> times = forced.joints(0.0, end);
  for (std::size_t k = 1; k < times.size(); ++k) {
    const ForcedMotion::Motion next = forced.integrate(motion, times[k - 1], times[k]);
    manoeuvre.pieces.push_back(
        placed.piece(forced.piece(motion, times[k - 1], next, times[k]), position));
    motion = next;
  }
  manoeuvre.joint = placed.point(forced.flat(motion, end), position);
  return manoeuvre;
}

Manoeuvre arrival(const Eigen::Vector2d& position, double psi_rad, double turn_rad,
                  double speed_mps, const vessel::Parameters& vessel,
                  const ManoeuvreLimits& limits) {
  const Thrust thrust(vessel, limits);
  const double brake_n = limits.astern_share * thrust.astern_n;
  const double turn_left = std::abs(turn_rad);
  std::optional<TurnProfile> turn;
  std::vector<SurgeRamp> ramps;
  double braked_s = 0.0;  // the end of full astern, on the turn's clock
  double end_s = 0.0;
  if (turn_left > kLeastTurnRad) {
    const double drift_n = driftForce(turn_left, vessel, limits, thrust);
    turn = turnToRest(turn_left, thrust.turning(-drift_n), limits.yaw_rate_max_radps, thrust.lag_s,
                      limits.ramp_s);
    end_s = turn->end();
    // The moment rises when the force has nearly gone.
    const double late = drift_n > 0.0 ? limits.ramp_s : 0.0;
    braked_s = late - limits.surge_ramp_s;
    ramps.push_back({braked_s, late, -brake_n, -drift_n});
  } else {
    ramps.push_back({kLongAgoS, kLongAgoS, -brake_n, -brake_n});
  }
  ForcedMotion forced(vessel, turn ? &*turn : nullptr, std::move(ramps));
  BackwardMotion back(forced, end_s);
  back.reach(braked_s);
  // Full astern: v = (v_0 + F / d1) exp(-(t - t_0) d1 / m1) - F / d1, here backward.
  const double slip = brake_n / vessel.paper.d1_kgps;
  const double ahead = std::max(back.motion().velocity.x(), 0.0);
  const double brakes_s = vessel.paper.m1_kg / vessel.paper.d1_kgps *
                          std::log(std::max((speed_mps + slip) / (ahead + slip), 1.0));
  back.reach(braked_s - brakes_s);
  const double begin_s = braked_s - brakes_s - limits.brake_ramp_s;
  if (!turn) {
    forced.clearRamps();
  }
  forced.addFirst({begin_s, begin_s + limits.brake_ramp_s, kAheadShare * thrust.ahead_n, -brake_n});
  back.reach(begin_s);

  const bool left = turn_rad >= 0.0;
  const Placed placed(psi_rad - turn_rad, left);
  Manoeuvre manoeuvre;
  back.append(placed, position, manoeuvre.pieces);
  manoeuvre.joint = placed.point(forced.flat(back.motion(), begin_s), position);
  manoeuvre.duration_s = end_s - begin_s;
  return manoeuvre;
}

double arrivalLength(double speed_mps, const vessel::Parameters& vessel,
                     const ManoeuvreLimits& limits) {
  const double braking = limits.astern_share * 2.0 * limits.thrust_share *
                         vessel.thrusters.astern_max_n / vessel.paper.m1_kg;
  return speed_mps * speed_mps / (2.0 * braking) + speed_mps * limits.brake_ramp_s +
         limits.drift_mps;
}

}  // namespace otter_nav::optimizer
