#include "otter_nav/stopping/braking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "coming_to_rest.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/parts.hpp"
#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/stopping/splice.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "otter_nav/trajectory/joint.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "otter_nav/vessel/thrusters.hpp"
#include "straight_stop.hpp"

namespace otter_nav::stopping {
namespace {

using trajectory::Piece;
using trajectory::PieceKind;
using trajectory::Trajectory;
using vessel::FlatPoint;

constexpr double kUnderWayMps = 0.3;
constexpr double kKnotS = 0.25;
// The sailed trajectory may be at the thrusters' limits, or over them, where the stop begins; the
// tracker shaves off a short peak.
constexpr double kLeastForceShare = 0.01;  // |w| while turning, of both thrusters ahead
constexpr double kThrustTolerance = 1.1;
constexpr double kMuchThrust = 2.0;  // where nothing is clear

// Along the way with its time slowed down smoothly to nothing within `duration_s`: z(s(t)) with
// s' = 1 - (10 x^3 - 15 x^4 + 6 x^5), x = t / duration. Half the duration of way is used up.
struct SlowedTime {
  SlowedTime(double t, double duration_s) {
    const double x = t / duration_s;
    const double x2 = x * x;
    const double x3 = x2 * x;
    passed_s = duration_s * (x - x2 * x2 * (2.5 - 3.0 * x + x2));
    rate = 1.0 - x3 * (10.0 - 15.0 * x + 6.0 * x2);
    rate1 = -30.0 * x2 * (1.0 - 2.0 * x + x2) / duration_s;
    rate2 = -60.0 * x * (1.0 - 3.0 * x + 2.0 * x2) / (duration_s * duration_s);
  }
  [[nodiscard]] FlatPoint of(const FlatPoint& z) const {
    FlatPoint slowed;
    slowed.position = z.position;
    slowed.velocity = z.velocity * rate;
    slowed.acceleration = z.acceleration * (rate * rate) + z.velocity * rate1;
    slowed.jerk =
        z.jerk * (rate * rate * rate) + z.acceleration * (3.0 * rate * rate1) + z.velocity * rate2;
    return slowed;
  }
  double passed_s, rate, rate1, rate2;
};

// A heading of its own with its derivatives, as the x of a point.
FlatPoint ownHeading(const Trajectory& sailed, double at_s) {
  const std::size_t k = sailed.pieceAt(at_s);
  const Piece& piece = sailed.pieces()[k];
  Piece turning;
  turning.position.row(0) = piece.heading;
  return turning.flat(std::clamp(at_s - sailed.startOf(k), 0.0, piece.duration_s));
}

bool hasOwnHeading(const Trajectory& sailed, double from_s, double to_s) {
  const std::size_t last = sailed.pieceAt(to_s);
  for (std::size_t k = sailed.pieceAt(from_s); k <= last; ++k) {
    if (sailed.pieces()[k].kind != PieceKind::kSpin) {
      return false;
    }
  }
  return true;
}

Trajectory slowed(const Trajectory& sailed, double at_s, double duration_s) {
  const int knots = partsOf(duration_s, kKnotS, 4);
  const double step = duration_s / knots;
  const bool held = hasOwnHeading(sailed, at_s, at_s + 0.5 * duration_s);
  const SlowedTime first(0.0, duration_s);
  FlatPoint previous = first.of(sailed.flat(at_s));
  FlatPoint heading = held ? first.of(ownHeading(sailed, at_s)) : FlatPoint{};
  std::vector<Piece> pieces;
  for (int k = 1; k <= knots; ++k) {
    const SlowedTime time(k * step, duration_s);
    const FlatPoint next = time.of(sailed.flat(at_s + time.passed_s));
    pieces.push_back(trajectory::hermitePiece(previous, next, step));
    previous = next;
    if (held) {
      const FlatPoint turned = time.of(ownHeading(sailed, at_s + time.passed_s));
      pieces.back().kind = PieceKind::kSpin;
      pieces.back().heading = trajectory::hermitePiece(heading, turned, step).position.row(0);
      heading = turned;
    }
  }
  return Trajectory(std::move(pieces));
}

// Astern, a planned stop leaves part of the thrust to the tracker.
bool keepsAsternShare(const Trajectory& trajectory, const vessel::Parameters& vessel) {
  constexpr double kShare = 0.9;
  constexpr double kStepS = 0.05;
  const int steps = partsOf(trajectory.duration(), kStepS, 0);
  for (int k = 0; k <= steps; ++k) {
    const double least = trajectory.sample(k * kStepS, vessel).thrusts.minCoeff();
    if (least < -kShare * vessel.thrusters.astern_max_n) {
      return false;
    }
  }
  return true;
}

// Where a sailed trajectory comes to rest by itself soon, without gathering way before: the rest of
// a voyage is no stop.
std::optional<Trajectory> ownRest(const Trajectory& sailed, double at_s, double within_s) {
  constexpr double kFasterMps = 0.05;
  constexpr double kStepS = 0.1;
  const double fastest = sailed.flat(at_s).velocity.norm() + kFasterMps;
  std::vector<Piece> pieces = remainder(sailed, at_s).pieces();
  double duration = 0.0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    duration += pieces[k].duration_s;
    if (duration > within_s) {
      return std::nullopt;
    }
    for (double t = 0.0; t < pieces[k].duration_s; t += kStepS) {
      if (pieces[k].flat(t).velocity.norm() > fastest) {
        return std::nullopt;
      }
    }
    if (endsAtRest(pieces[k])) {
      pieces.resize(k + 1);
      return Trajectory(std::move(pieces));
    }
  }
  return std::nullopt;
}

// A vessel that hardly moves, or turns on the spot, is held where it is. Where hardly any force
// tells the flat heading, it may turn faster than any hull, and no hull has followed it: the less
// firmly it is told, the less of its turning goes on.
Trajectory halt(const Trajectory& sailed, double at_s, const vessel::Parameters& vessel,
                const vessel::Disturbance& disturbance) {
  constexpr double kHaltS = 1.0;
  constexpr double kDifferenceS = 1e-3;
  constexpr double kFirmShare = 0.1;  // of both thrusters ahead
  const trajectory::Sample here = sailed.sample(at_s, vessel, disturbance);
  const double fastest = feasibility::SafetyLimits::of(vessel).yaw_rate_max_radps;
  const double firm_n = kFirmShare * 2.0 * vessel.thrusters.ahead_max_n;
  const auto rate = [&](const trajectory::Sample& sample) {
    const double told = std::min(1.0, sample.heading_force_n / firm_n);
    return told * std::clamp(sample.state[vessel::kYawRate], -fastest, fastest);
  };
  const double now = rate(here);
  const double later = rate(sailed.sample(at_s + kDifferenceS, vessel, disturbance));
  FlatPoint rest;
  rest.position = here.flat.position + 0.5 * kHaltS * here.flat.velocity;
  Piece piece = trajectory::hermitePiece(here.flat, rest, kHaltS);
  piece.kind = PieceKind::kSpin;
  FlatPoint from;  // its x the heading
  from.position.x() = here.state[vessel::kPsi];
  from.velocity.x() = now;
  from.acceleration.x() =
      std::clamp((later - now) / kDifferenceS, -fastest / kHaltS, fastest / kHaltS);
  FlatPoint to;
  to.position.x() = from.position.x() + 0.5 * kHaltS * from.velocity.x();
  piece.heading = trajectory::hermitePiece(from, to, kHaltS).position.row(0);
  return Trajectory({piece});
}

// Stops in the order in which they are tried, each made when it is asked for: the usual ones first,
// then harder and harder ones, at last those that take more of the way.
class Candidates {
 public:
  Candidates(const Trajectory& sailed, double at_s)
      : sailed_(sailed),
        at_s_(at_s),
        from_(sailed.flat(at_s)),
        under_way_(from_.velocity.norm() > kUnderWayMps) {}

  [[nodiscard]] std::size_t count() const {
    return under_way_ ? kSlowS.size() + kStraight.size() + 1 : 1;
  }
  // Empty where there is none of that kind.
  [[nodiscard]] Trajectory make(std::size_t k) const {
    if (k + 1 == count()) {
      return ownRest(sailed_, at_s_, kSlowS.back()).value_or(Trajectory{});
    }
    if (k < kFirstSlow) {
      return slow(kSlowS[k]);
    }
    k -= kFirstSlow;
    return k < kStraight.size() ? straightStop(from_, kStraight[k])
                                : slow(kSlowS[kFirstSlow + k - kStraight.size()]);
  }

 private:
  static constexpr std::size_t kFirstSlow = 2;  // before the straight ones
  static constexpr std::array<double, 5> kSlowS = {5.5, 4.0, 7.0, 9.0, 12.0};
  static constexpr std::array<StraightStop, 16> kStraight = {{{3.0, 4.5},
                                                              {2.0, 4.5},
                                                              {2.0, 3.2},
                                                              {2.0, 2.4},
                                                              {1.3, 3.2},
                                                              {1.3, 2.4},
                                                              {0.9, 3.2},
                                                              {0.6, 3.2},
                                                              {0.9, 2.4},
                                                              {0.9, 2.0},
                                                              {0.3, 3.2},
                                                              {0.6, 2.4},
                                                              {0.6, 2.0},
                                                              {0.3, 2.4},
                                                              {0.3, 2.0},
                                                              {0.3, 1.6}}};

  // Of a way long enough for it.
  [[nodiscard]] Trajectory slow(double duration_s) const {
    return sailed_.duration() - at_s_ > 0.5 * duration_s ? slowed(sailed_, at_s_, duration_s)
                                                         : Trajectory{};
  }

  const Trajectory& sailed_;
  double at_s_;
  FlatPoint from_;
  bool under_way_;
};

// Whether the hull makes way on a heading of its own, pushed by what gives a resting one its
// heading: no stop along the path has that.
bool carriedByLoad(const Trajectory& sailed, double at_s, const vessel::Parameters& vessel,
                   const vessel::Disturbance& load) {
  return vessel::isFirmLoad(vessel, load) && hasOwnHeading(sailed, at_s, at_s);
}

// Whether a stop begins in the attitude that the vessel has.
bool goesOnFrom(const trajectory::Sample& here, const Trajectory& stop,
                const vessel::Parameters& vessel) {
  constexpr double kTurnRad = 0.1;
  const double psi = stop.sampleIn(0, 0.0, vessel).state[vessel::kPsi];
  return std::abs(wrapAngle(psi - here.state[vessel::kPsi])) < kTurnRad;
}

// What it gets faster than it begins, m/s.
double gathersWay(const trajectory::Sample& here, const Trajectory& stop) {
  constexpr double kStepS = 0.1;
  double fastest = 0.0;
  for (double t = 0.0; t < stop.duration(); t += kStepS) {
    fastest = std::max(fastest, stop.flat(t).velocity.norm());
  }
  return fastest - here.flat.velocity.norm();
}

// What is preferred beside the outline where a stop ends on the heading `psi_rad`, m. What would
// set the hull aside there is held by turning it to and fro with way on, for it has no other force
// abeam.
double roomToSwing(const StopLimits& stop, const vessel::Parameters& vessel, double psi_rad) {
  constexpr double kSetAsideMps = 0.2;  // from here on it swings by all of that
  const double aside_mps = vessel::setAside(vessel.manoeuvring, stop.rest_load, psi_rad);
  return std::max(stop.rest_room_m, kSwingsM * std::min(1.0, aside_mps / kSetAsideMps));
}

}  // namespace

double roomAtRest(const Trajectory& stop, const feasibility::Obstacles& obstacles,
                  const vessel::Parameters& vessel) {
  const double end = stop.duration();
  const vessel::State rests = stop.sample(end, vessel).state;
  return feasibility::outlineClearance(
      vessel.hull, rests.head<2>(), rests[vessel::kPsi],
      [&](const Eigen::Vector2d& p) { return obstacles.clearance(p, end); });
}

Braking brakingTrajectory(const Trajectory& sailed, double at_s,
                          const feasibility::Obstacles& obstacles, const vessel::Parameters& vessel,
                          const StopLimits& stop) {
  feasibility::SafetyLimits limits = feasibility::SafetyLimits::of(vessel, stop.clearance_m);
  limits.hull_margin_m = stop.hull_margin_m;
  limits.felt = stop.felt;
  limits.speed_max_mps = 2.0 * vessel.top_speed_mps;
  feasibility::Tolerances tolerances;
  tolerances.heading_force_share = kLeastForceShare;
  tolerances.step_s = 0.02;
  const feasibility::Obstacles ahead = obstacles.startingAt(at_s);
  // Of the path alone: against a steady force the heading would swing as the way comes off.
  const trajectory::Sample here = sailed.sample(at_s, vessel);
  limits.thrust_share =
      kThrustTolerance * std::max(1.0, vessel::shareOfLimit(here.thrusts, vessel.thrusters));
  // What the centre keeps in any attitude, to be looked at first.
  const double centre_m =
      std::max(stop.clearance_m, feasibility::HullCover(vessel.hull, stop.hull_margin_m).middle_m);
  // Whether the vessel could follow it, whatever is in the way: it may brake too hard, but not
  // swing. What begins in another attitude than its own it does not follow at all.
  enum class Follows { kNever, kHardly, kWell };
  const auto follows = [&](const Trajectory& candidate) {
    feasibility::SafetyLimits alone = limits;
    alone.clearance_m = -1.0;
    alone.thrust_share *= kMuchThrust;
    feasibility::Tolerances open = tolerances;
    open.keep_hull_clear = false;
    if (!goesOnFrom(here, candidate, vessel)) {
      return Follows::kNever;
    }
    return feasibility::verify(candidate, ahead, vessel, alone, open).ok ? Follows::kWell
                                                                         : Follows::kHardly;
  };
  Braking best;
  best.clearance_m = -1.0;
  Follows best_follows = Follows::kNever;
  double best_path_m = 0.0;
  Touch best_touch;
  // Clear, but something comes over the place of rest: the one that has longest until then.
  Braking overrun;
  double overrun_s = 0.0;
  const auto staysFree = [&](Trajectory& candidate) {
    const double after_s = firstTouch(candidate, 0.0, ahead, vessel).after_s;
    if (std::isinf(after_s)) {
      return true;
    }
    if (after_s > overrun_s) {
      overrun_s = after_s;
      overrun = {std::move(candidate), true, stop.clearance_m};
    }
    return false;
  };
  // Clear, but for the hull's swinging at rest: the one with most room for it.
  Braking cramped;
  double cramped_room_m = -std::numeric_limits<double>::infinity();
  const auto hasRoom = [&](Trajectory& candidate) {
    const double psi_rad = candidate.sample(candidate.duration(), vessel).state[vessel::kPsi];
    const double wanted_m = roomToSwing(stop, vessel, psi_rad);
    const double room_m = wanted_m > 0.0 ? roomAtRest(candidate, ahead, vessel) : 0.0;
    if (room_m < wanted_m && room_m > cramped_room_m) {
      cramped_room_m = room_m;
      cramped = {std::move(candidate), true, stop.clearance_m};
    }
    return room_m >= wanted_m;
  };
  const bool under_way = here.flat.velocity.norm() > kUnderWayMps;
  if (!under_way) {
    Trajectory held = halt(sailed, at_s, vessel, stop.disturbance);
    if (!outlineConflict(held, 0.0, held.duration(), ahead, vessel, stop.hull_margin_m).found) {
      return {std::move(held), true, stop.clearance_m};
    }
    best_touch = firstTouch(held, 0.0, ahead, vessel, stop.off);
    best_follows = Follows::kWell;
    best = {std::move(held), false, 0.0};
  }
  const auto keeps = [&](const Trajectory& candidate, bool own) {
    return !firstConflict(candidate, 0.0, ahead, centre_m).found &&
           goesOnFrom(here, candidate, vessel) && (own || keepsAsternShare(candidate, vessel)) &&
           feasibility::verify(candidate, ahead, vessel, limits, tolerances).ok &&
           firstTouch(candidate, 0.0, ahead, vessel, stop.off).speed_mps == 0.0;
  };
  // No more than what is left of an acceleration as it dies out; of a hard one that is more, where
  // nothing else will do.
  constexpr double kFasterMps = 0.5;
  constexpr double kMuchFasterMps = 1.5;
  std::vector<Trajectory> faster;
  const Candidates candidates(sailed, at_s);
  for (std::size_t k = 0; k < candidates.count(); ++k) {
    Trajectory candidate = candidates.make(k);
    if (candidate.empty()) {
      continue;
    }
    const double gathered_mps = gathersWay(here, candidate);
    if (gathered_mps > kFasterMps) {
      if (gathered_mps <= kMuchFasterMps) {
        faster.push_back(std::move(candidate));
      }
      continue;
    }
    const bool own = k + 1 == candidates.count();
    if (keeps(candidate, own)) {
      if (staysFree(candidate) && hasRoom(candidate)) {
        return {std::move(candidate), true, stop.clearance_m};
      }
      continue;
    }
    const Touch touch = firstTouch(candidate, 0.0, ahead, vessel, stop.off);
    const double clearance = leastClearance(candidate, 0.0, ahead);
    const double path_m =
        (candidate.flat(candidate.duration()).position - here.flat.position).norm();
    const Follows followed = follows(candidate);
    const bool same = !touch.milderThan(best_touch) && !best_touch.milderThan(touch);
    const bool farther =
        clearance > best.clearance_m || (clearance == best.clearance_m && path_m < best_path_m);
    const bool better = followed != best_follows ? followed > best_follows
                        : same                   ? farther
                                                 : touch.milderThan(best_touch);
    if (best.trajectory.empty() || better) {
      best_follows = followed;
      best = {std::move(candidate), false, clearance};
      best_path_m = path_m;
      best_touch = touch;
    }
  }
  if (cramped.clear) {
    return cramped;
  }
  for (Trajectory& candidate : faster) {
    if (keeps(candidate, false) && staysFree(candidate)) {
      return {std::move(candidate), true, stop.clearance_m};
    }
  }
  if (carriedByLoad(sailed, at_s, vessel, stop.disturbance)) {
    Trajectory carried = carriedToRest(sailed.sample(at_s, vessel, stop.disturbance).state, vessel,
                                       stop.disturbance);
    if (!carried.empty() && !firstConflict(carried, 0.0, ahead, stop.clearance_m).found &&
        !outlineConflict(carried, 0.0, carried.duration(), ahead, vessel, stop.hull_margin_m)
             .found &&
        firstTouch(carried, 0.0, ahead, vessel, stop.off).speed_mps == 0.0 && staysFree(carried)) {
      return {std::move(carried), true, stop.clearance_m};
    }
  }
  return overrun.clear ? overrun : best;
}

}  // namespace otter_nav::stopping
