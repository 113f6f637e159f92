#include "otter_nav/stopping/escape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::stopping {
namespace {

using trajectory::Piece;
using vessel::State;
using vessel::Thrusts;

constexpr double kEscapeStepS = 0.1;
constexpr int kEscapeSteps = 70;
constexpr double kEscapeShare = 0.9;  // of the thrust: the rest is the tracker's, to keep to it

double clearanceAt(const feasibility::HullCover& cover, const feasibility::Obstacles& obstacles,
                   const Eigen::Vector2d& position, double psi_rad, double time_s) {
  double centre_m = 0.0;
  return cover.slack(
      obstacles, position, time_s, 0.0, [&] { return unitVector(psi_rad); }, centre_m);
}

// Turns bow or stern to what pushes, whichever is nearer, and brakes with the thrust left.
class ComingToRest {
 public:
  ComingToRest(const vessel::Parameters& vessel, const vessel::Disturbance& disturbance)
      : vessel_(vessel), disturbance_(disturbance) {}

  [[nodiscard]] double off(const State& x) const {
    const double psi = x[vessel::kPsi];
    const double to_bow =
        wrapAngle(vessel::headingIntoLoad(vessel_.manoeuvring, disturbance_, psi) - psi);
    return std::abs(to_bow) > 0.5 * kPi ? wrapAngle(to_bow + kPi) : to_bow;
  }
  [[nodiscard]] Thrusts thrusts(const State& x) const {
    constexpr double kTurnsS = 0.5;  // time constant of heading and rate
    constexpr double kBrakesS = 0.5;
    const vessel::Thrusters& t = vessel_.thrusters;
    const vessel::ManoeuvringModel& m = vessel_.manoeuvring;
    const vessel::OutsideLoad load = vessel::outsideLoad(x[vessel::kPsi], m, disturbance_);
    const double most_nm = kEscapeShare * vessel::greatestMoment(t);
    const double wanted_nm =
        m.yaw_inertia_kgm2 / kTurnsS * (off(x) / kTurnsS - 2.0 * x[vessel::kYawRate]) - load.yaw_nm;
    const double yaw_nm = std::clamp(wanted_nm, -most_nm, most_nm);
    const double surge_n = -m.surge_inertia_kg * x[vessel::kSurge] / kBrakesS - load.surge_n;
    const double turning_n = 0.5 * std::abs(yaw_nm) / t.lever_arm_m;
    const double ahead_n = std::max(0.0, kEscapeShare * t.ahead_max_n - turning_n);
    const double astern_n = std::max(0.0, kEscapeShare * t.astern_max_n - turning_n);
    return vessel::thrustsFromTau({std::clamp(surge_n, -2.0 * astern_n, 2.0 * ahead_n), yaw_nm}, t);
  }

 private:
  const vessel::Parameters& vessel_;
  const vessel::Disturbance& disturbance_;
};

class Search {
 public:
  Search(const State& state, const feasibility::Obstacles& obstacles,
         const vessel::Parameters& vessel, const vessel::Disturbance& disturbance)
      : obstacles_(obstacles),
        vessel_(vessel),
        disturbance_(disturbance),
        rest_(vessel, disturbance),
        cover_(vessel.hull),
        fastest_mps_(std::max(vessel.top_speed_mps, vessel::speedOf(state))) {
    motion_.states[0] = state;
    motion_.clear_m = clearanceAt(cover_, obstacles_, state.head<2>(), state[vessel::kPsi], 0.0);
  }

  Escape find() {
    const double ahead = kEscapeShare * vessel_.thrusters.ahead_max_n;
    const double astern = -kEscapeShare * vessel_.thrusters.astern_max_n;
    const std::array<Thrusts, 8> pairs = {Thrusts(ahead, ahead),  Thrusts(astern, astern),
                                          Thrusts(0.0, ahead),    Thrusts(ahead, 0.0),
                                          Thrusts(astern, 0.0),   Thrusts(0.0, astern),
                                          Thrusts(astern, ahead), Thrusts(ahead, astern)};
    constexpr std::array<int, 3> kFirst = {5, 10, 18};  // steps
    constexpr std::array<int, 3> kSecond = {0, 10, 20};
    comeToRest(motion_, 0);
    for (const Thrusts& first : pairs) {
      Motion begun = motion_;
      int at = 0;
      for (const int until : kFirst) {
        at = push(begun, at, until, first);
        for (const Thrusts& second : pairs) {
          Motion on = begun;
          int then = at;
          for (const int more : kSecond) {
            then = push(on, then, until + more, second);
            comeToRest(on, then);
          }
        }
      }
    }
    return {path(), best_.clear_m};
  }

 private:
  static constexpr double kMostRoomM = 3.0;

  struct Motion {
    std::array<State, kEscapeSteps + 1> states;
    double clear_m = 0.0;  // at the least
    double room_m = 0.0;   // sum over steps
  };

  int push(Motion& motion, int from, int to, const Thrusts& thrusts) const {
    for (int k = from; k < to; ++k) {
      step(motion, k, thrusts);
    }
    return std::max(from, to);
  }
  void step(Motion& motion, int k, const Thrusts& thrusts) const {
    const auto rate = [&](double, const State& x) {
      return vessel::stateDerivative(x, thrusts, vessel_.manoeuvring, vessel_.thrusters,
                                     disturbance_);
    };
    const auto i = static_cast<std::size_t>(k);
    const State& next = motion.states[i + 1] = rk4Step(rate, 0.0, motion.states[i], kEscapeStepS);
    const double clear_m =
        clearanceAt(cover_, obstacles_, next.head<2>(), next[vessel::kPsi], (k + 1) * kEscapeStepS);
    const bool too_fast = vessel::speedOf(next) > fastest_mps_;
    motion.clear_m =
        too_fast ? std::numeric_limits<double>::lowest() : std::min(motion.clear_m, clear_m);
    motion.room_m += std::min(clear_m, kMostRoomM);
  }
  // By value: what was pushed is gone on with.
  void comeToRest(Motion motion, int from) {
    constexpr double kEnoughM = 1.5;
    constexpr double kRoomShare = 0.2;
    constexpr double kLaterM = 0.005;  // a step more
    for (int k = from; k < kEscapeSteps; ++k) {
      if (std::min(motion.clear_m, kEnoughM) + kRoomShare * kMostRoomM < best_value_) {
        return;
      }
      step(motion, k, rest_.thrusts(motion.states[static_cast<std::size_t>(k)]));
    }
    const double value = std::min(motion.clear_m, kEnoughM) +
                         kRoomShare * motion.room_m / kEscapeSteps - kLaterM * from;
    if (value > best_value_) {
      best_value_ = value;
      best_ = motion;
      pushed_ = from;
    }
  }
  [[nodiscard]] trajectory::Trajectory path() const {
    constexpr double kSlowMps = 0.3;
    constexpr double kIntoRad = 0.4;
    int last = std::max(pushed_, 1);
    const auto at = [&](int k) { return best_.states[static_cast<std::size_t>(k)]; };
    while (last < kEscapeSteps &&
           (vessel::speedOf(at(last)) > kSlowMps || std::abs(rest_.off(at(last))) > kIntoRad)) {
      ++last;
    }
    std::vector<Piece> pieces;
    pieces.reserve(static_cast<std::size_t>(last));
    for (int k = 0; k < last; ++k) {
      pieces.push_back(piece(at(k), at(k + 1)));
    }
    return trajectory::Trajectory(std::move(pieces));
  }
  // Cubic: the thrusts, and with them the accelerations, jump.
  static Piece piece(const State& from, const State& to) {
    Piece piece;
    piece.kind = trajectory::PieceKind::kSpin;
    piece.duration_s = kEscapeStepS;
    const auto cubic = [](auto row, double a, double a_rate, double b, double b_rate) {
      const double t = kEscapeStepS;
      row[0] = a;
      row[1] = a_rate;
      row[2] = (3.0 * (b - a) / t - 2.0 * a_rate - b_rate) / t;
      row[3] = (2.0 * (a - b) / t + a_rate + b_rate) / (t * t);
    };
    const Eigen::Vector2d v = vessel::velocityOverGround(from);
    const Eigen::Vector2d w = vessel::velocityOverGround(to);
    cubic(piece.position.row(0), from.x(), v.x(), to.x(), w.x());
    cubic(piece.position.row(1), from.y(), v.y(), to.y(), w.y());
    cubic(piece.heading.row(0), from[vessel::kPsi], from[vessel::kYawRate], to[vessel::kPsi],
          to[vessel::kYawRate]);
    return piece;
  }

  const feasibility::Obstacles& obstacles_;
  const vessel::Parameters& vessel_;
  const vessel::Disturbance& disturbance_;
  ComingToRest rest_;
  feasibility::HullCover cover_;
  // With the wind it gets faster, and nobody knows how the hull does then.
  double fastest_mps_;
  Motion motion_;
  Motion best_;
  double best_value_ = -std::numeric_limits<double>::infinity();
  int pushed_ = 0;
};

}  // namespace

double leastClearance(const vessel::Foreseen& foreseen, double from_s, double to_s,
                      const feasibility::Obstacles& obstacles, const vessel::Hull& hull) {
  const feasibility::HullCover cover(hull);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < foreseen.poses.size(); ++k) {
    const double time_s = foreseen.start_s + static_cast<double>(k) * foreseen.step_s;
    if (time_s >= from_s && time_s <= to_s) {
      least = std::min(least, clearanceAt(cover, obstacles, foreseen.poses[k].position,
                                          foreseen.poses[k].psi_rad, time_s));
    }
  }
  return least;
}

vessel::Foreseen driftingOn(vessel::Foreseen foreseen, double until_s) {
  constexpr double kLastS = 2.0;
  constexpr double kDriftMostMps = 1.0;
  if (!(foreseen.step_s > 0.0)) {
    return foreseen;
  }
  const std::size_t poses = foreseen.poses.size();
  const auto back = static_cast<std::size_t>(std::lround(kLastS / foreseen.step_s));
  if (back == 0 || poses <= back) {
    return foreseen;
  }
  const vessel::Pose last = foreseen.poses.back();
  const Eigen::Vector2d a_step =
      (last.position - foreseen.poses[poses - 1 - back].position) / static_cast<double>(back);
  if (a_step.norm() > kDriftMostMps * foreseen.step_s) {
    return foreseen;
  }
  const double end_s = foreseen.start_s + static_cast<double>(poses - 1) * foreseen.step_s;
  for (int k = 1; end_s + k * foreseen.step_s <= until_s; ++k) {
    foreseen.poses.push_back({last.position + k * a_step, last.psi_rad});
  }
  return foreseen;
}

Escape escape(const State& state, const feasibility::Obstacles& obstacles,
              const vessel::Parameters& vessel, const vessel::Disturbance& disturbance) {
  return Search(state, obstacles, vessel, disturbance).find();
}

}  // namespace otter_nav::stopping
