#include "optimizer/ends/end_manoeuvre.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "optimizer/ends/forced_motion.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/rest.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kLeastTurnRad = 1e-3;
constexpr double kStraightLaunchS = 0.4;
constexpr double kLaunchShare = 0.95;  // of the full force, so that the way may turn at once
// Under a low speed limit: with steady thrust at this share of it where the launch ends, after so
// long, and where the arrival begins.
constexpr double kLaunchSpeedShare = 0.8;
constexpr double kGentleLaunchS = 1.6;
constexpr double kGentleRampS = 0.6;
constexpr double kBrakeSpeedShare = 0.9;
constexpr double kAheadShare = 0.5;       // of the full force, before that
constexpr double kDriftForceShare = 0.4;  // of full astern, at most, while turning at the goal
constexpr double kLeastBrakeShare = 0.1;  // of the force astern, that is left against a load
constexpr double kLongAgoS = -1e3;
// Of full ahead against full astern: less is left to turn by only where no turn would verify.
constexpr double kLeastMomentShare = 0.02;
// A hull that turns by other laws than the paper's keeps more back for it when it goes ahead,
constexpr double kLaunchShareTurning = 0.85;
// and settles on its course for so long before it brakes.
constexpr double kRunInS = 0.8;

struct Thrust {
  double ahead_n, astern_n;  // both thrusters together
  double load_nm;            // the most that wind and waves turn the hull with
  double kept_nm;            // of the moment while turning
  const vessel::Parameters& vessel;

  Thrust(const vessel::Parameters& v, const ManoeuvreLimits& limits)
      : ahead_n(2.0 * limits.thrust_share * v.thrusters.ahead_max_n),
        astern_n(2.0 * limits.thrust_share * v.thrusters.astern_max_n),
        load_nm(std::abs(limits.disturbance.moment_nm) +
                0.5 * std::abs(v.manoeuvring.wind_yaw_kg) *
                    limits.disturbance.wind_mps.squaredNorm()),
        kept_nm(limits.kept_nm),
        vessel(v) {}

  // What the load's moment leaves for pushing ahead, or astern.
  [[nodiscard]] double leftAhead() const { return left(ahead_n); }
  [[nodiscard]] double leftAstern() const { return left(astern_n); }
  [[nodiscard]] double left(double of_n) const {
    return std::max(of_n - load_nm / vessel.thrusters.lever_arm_m, kLeastBrakeShare * of_n);
  }
  // With the moment that is left beside a surge force.
  [[nodiscard]] vessel::TurnLaw turning(double surge_n) const {
    const double lever_m = vessel.thrusters.lever_arm_m;
    const double moment =
        lever_m * std::min(ahead_n - surge_n, astern_n + surge_n) - load_nm - kept_nm;
    return vessel::turnLaw(vessel, std::max(moment, kLeastMomentShare * lever_m * ahead_n));
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

  // The disturbance as it is seen from there.
  [[nodiscard]] vessel::Disturbance seen(const vessel::Disturbance& earth) const {
    vessel::Disturbance local;
    local.current_mps = matrix_.transpose() * earth.current_mps;
    local.wind_mps = matrix_.transpose() * earth.wind_mps;
    local.force_n = matrix_.transpose() * earth.force_n;
    local.moment_nm = side_ * earth.moment_nm;
    return local;
  }

 private:
  double base_rad_;
  double side_;
  Eigen::Matrix2d matrix_;
};

// A forced motion followed backward from the origin, joint by joint.
class BackwardMotion {
 public:
  BackwardMotion(const ForcedMotion& forced, double end_s, const Eigen::Vector2d& end_velocity)
      : forced_(forced), times_{end_s}, motions_{{Eigen::Vector2d::Zero(), end_velocity}} {}

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
    const vessel::TurnLaw law = thrust.turning(-force);
    const double lasts =
        turnToRest(turn_rad, law.r_full, limits.yaw_rate_max_radps, law.lag_s, limits.ramp_s).end();
    force = std::min(most, vessel.paper.d1_kgps * limits.drift_mps / std::expm1(lasts / lag));
  }
  return force;
}

// Over ground, of a hull that lies along the x axis under a load from abeam: by the manoeuvring
// model it comes to rest ahead and drifts on so. By the paper's it is led to rest on both axes.
Eigen::Vector2d restingDrift(const vessel::Parameters& vessel,
                             const vessel::Disturbance& disturbance) {
  return {0.0, vessel::paperHolds(vessel)
                   ? 0.0
                   : vessel::driftAbeam(vessel.manoeuvring, disturbance, 0.0)};
}

// A turn on the spot to `position`, followed forward from rest: what the turn and the load push
// aside no thruster holds, so it begins at `from` and ends with a little drift. Its duration.
double turnAtRest(double turn_rad, const Placed& placed, const Eigen::Vector2d& position,
                  const Eigen::Vector2d& velocity, const vessel::Parameters& vessel,
                  const ManoeuvreLimits& limits, Eigen::Vector2d& from,
                  std::vector<trajectory::Piece>& pieces) {
  const vessel::TurnLaw law = Thrust(vessel, limits).turning(0.0);
  const TurnProfile turn =
      turnToRest(turn_rad, law.r_full, limits.yaw_rate_max_radps, law.lag_s, limits.ramp_s);
  const ForcedMotion forced(vessel, placed.seen(limits.disturbance), &turn,
                            {{kLongAgoS, kLongAgoS, 0.0, 0.0}});
  const std::vector<double> times = forced.joints(0.0, turn.end());
  std::vector<ForcedMotion::Motion> motions = {{Eigen::Vector2d::Zero(), velocity}};
  for (std::size_t k = 1; k < times.size(); ++k) {
    motions.push_back(forced.integrate(motions.back(), times[k - 1], times[k]));
  }
  vessel::FlatPoint end;
  end.position = motions.back().position;
  from = position - placed.point(end, Eigen::Vector2d::Zero()).position;
  for (std::size_t k = 1; k < times.size(); ++k) {
    pieces.push_back(
        placed.piece(forced.piece(motions[k - 1], times[k - 1], motions[k], times[k]), from));
  }
  return turn.end();
}

// The surge force that holds a speed along a heading, all in the manoeuvre's frame.
double steadyForce(const vessel::Parameters& vessel, const vessel::Disturbance& disturbance,
                   double heading_rad, double speed_mps) {
  const Eigen::Vector2d ahead = unitVector(heading_rad);
  return vessel::InverseDynamics(vessel, disturbance)
      .held(ahead, 0.0, 0.0, speed_mps * ahead, Eigen::Vector2d::Zero())
      .tau.surge_n;
}

}  // namespace

Manoeuvre launch(const Eigen::Vector2d& position, double psi_rad, double turn_rad,
                 const vessel::Parameters& vessel, const ManoeuvreLimits& limits) {
  const Thrust thrust(vessel, limits);
  const Placed placed(psi_rad, turn_rad >= 0.0);
  std::optional<TurnProfile> turn;
  const bool turns = std::abs(turn_rad) > kLeastTurnRad;
  const double share = turns && !vessel::paperHolds(vessel) ? kLaunchShareTurning : kLaunchShare;
  const vessel::Disturbance disturbance = placed.seen(limits.disturbance);
  const double speed = kLaunchSpeedShare * limits.speed_max_mps;
  const double steady_n = steadyForce(vessel, disturbance, std::abs(turn_rad), speed);
  const double full_n = share * thrust.leftAhead();
  // From a speed to the one wanted.
  const auto push = [&](double from_mps) {
    const double lacking = std::max(0.0, speed - from_mps);
    return std::min(full_n, steady_n + vessel.paper.m1_kg * lacking / kGentleLaunchS);
  };
  double most = push(0.0);
  const bool gentle = most < full_n;
  std::vector<SurgeRamp> ramps = {{kLongAgoS, kLongAgoS, most, most}};
  double turning_n = 0.0;
  double end = gentle ? 0.0 : kStraightLaunchS;
  if (turns) {
    // One thruster full ahead and the other full astern turn a hull best that has less astern: it
    // gets under way meanwhile.
    const bool even = limits.settle || vessel::paperHolds(vessel);
    if (!even) {
      turning_n =
          std::min(0.5 * (thrust.ahead_n - thrust.astern_n), 0.5 * speed * vessel.paper.d1_kgps);
    }
    const auto [lag_s, r_full] = thrust.turning(turning_n);
    double ahead_s = 0.0;
    if (limits.settle) {
      turn =
          turnToRest(std::abs(turn_rad), r_full, limits.yaw_rate_max_radps, lag_s, limits.ramp_s);
      ahead_s = turn->end();
    } else {
      const double brake = 0.5 * r_full / lag_s;
      LooseTurn loose = turnLoose(std::abs(turn_rad), r_full, limits.yaw_rate_max_radps, lag_s,
                                  limits.ramp_s, brake);
      turn = std::move(loose.profile);
      ahead_s = loose.moment_ends_s;
    }
    const double turned_mps =
        turning_n / vessel.paper.d1_kgps *
        (1.0 - std::exp(-ahead_s * vessel.paper.d1_kgps / vessel.paper.m1_kg));
    most = gentle ? push(turned_mps) : most;
    ramps = {{ahead_s, ahead_s + limits.surge_ramp_s, turning_n, most}};
    if (turning_n != 0.0) {
      ramps.insert(ramps.begin(), {0.0, limits.surge_ramp_s, 0.0, turning_n});
    }
    end = ramps.back().to_s;
  }
  if (gentle) {
    const double full_s = end + kGentleLaunchS - kGentleRampS;
    end = full_s + kGentleRampS;
    ramps.push_back({full_s, end, most, std::min(most, steady_n)});
  }
  const ForcedMotion forced(vessel, disturbance, turn ? &*turn : nullptr, std::move(ramps));
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
  const Placed placed(psi_rad - turn_rad, turn_rad >= 0.0);
  const vessel::Disturbance disturbance = placed.seen(limits.disturbance);
  const double brake_n = limits.astern_share * thrust.leftAstern();
  const double turn_left = std::abs(turn_rad);
  const bool turns_at_rest = turn_left > kLeastTurnRad && !vessel::paperHolds(vessel);
  std::optional<TurnProfile> turn;
  std::vector<SurgeRamp> ramps;
  double braked_s = 0.0;  // the end of full astern, on the turn's clock
  double end_s = 0.0;
  if (turns_at_rest) {
    braked_s = -limits.surge_ramp_s;
    ramps.push_back({braked_s, 0.0, -brake_n, 0.0});
  } else if (turn_left > kLeastTurnRad) {
    const double drift_n = driftForce(turn_left, vessel, limits, thrust);
    const vessel::TurnLaw law = thrust.turning(-drift_n);
    turn = turnToRest(turn_left, law.r_full, limits.yaw_rate_max_radps, law.lag_s, limits.ramp_s);
    end_s = turn->end();
    // The moment rises when the force has nearly gone.
    const double late = drift_n > 0.0 ? limits.ramp_s : 0.0;
    braked_s = late - limits.surge_ramp_s;
    ramps.push_back({braked_s, late, -brake_n, -drift_n});
  } else {
    ramps.push_back({kLongAgoS, kLongAgoS, -brake_n, -brake_n});
  }
  ForcedMotion forced(vessel, disturbance, turn ? &*turn : nullptr, std::move(ramps));
  const Eigen::Vector2d drift = restingDrift(vessel, disturbance);
  BackwardMotion back(forced, end_s, drift);
  back.reach(braked_s);
  // Full astern: v = (v_0 + F / d1) exp(-(t - t_0) d1 / m1) - F / d1, here backward; F is what the
  // load leaves of it.
  const double load_n = vessel::InverseDynamics(vessel, disturbance).loadAhead({1.0, 0.0});
  const double slip = std::max(brake_n - load_n, kLeastBrakeShare * brake_n) / vessel.paper.d1_kgps;
  const double ahead = std::max(back.motion().velocity.x(), 0.0);
  const double brakes_s = vessel.paper.m1_kg / vessel.paper.d1_kgps *
                          std::log(std::max((speed_mps + slip) / (ahead + slip), 1.0));
  back.reach(braked_s - brakes_s);
  const double ramp_s = braked_s - brakes_s - limits.brake_ramp_s;
  if (!turn && !turns_at_rest) {
    forced.clearRamps();
  }
  const double ahead_n =
      std::min(kAheadShare * thrust.leftAhead(),
               steadyForce(vessel, disturbance, 0.0, kBrakeSpeedShare * limits.speed_max_mps));
  forced.addFirst({ramp_s, ramp_s + limits.brake_ramp_s, ahead_n, -brake_n});
  back.reach(ramp_s);
  const double begin_s = vessel::paperHolds(vessel) ? ramp_s : ramp_s - kRunInS;
  back.reach(begin_s);

  std::vector<trajectory::Piece> last;
  Eigen::Vector2d stop = position;
  if (turns_at_rest) {
    end_s = turnAtRest(turn_left, placed, position, drift, vessel, limits, stop, last);
  }
  Manoeuvre manoeuvre;
  back.append(placed, stop, manoeuvre.pieces);
  // By the manoeuvring model the heading lags behind what came before, and settles on the way.
  for (trajectory::Piece& piece : manoeuvre.pieces) {
    if (!turn && !vessel::paperHolds(vessel)) {
      piece.kind = trajectory::PieceKind::kSail;
    }
  }
  manoeuvre.pieces.insert(manoeuvre.pieces.end(), last.begin(), last.end());
  manoeuvre.joint = placed.point(forced.flat(back.motion(), begin_s), stop);
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
