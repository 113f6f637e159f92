#include "otter_nav/stopping/escape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "coming_to_rest.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::stopping {
namespace {

using trajectory::Piece;
using vessel::State;
using vessel::Thrusts;

constexpr int kEscapeSteps = 70;

double clearanceAt(const feasibility::HullCover& cover, const feasibility::Obstacles& obstacles,
                   const Eigen::Vector2d& position, double psi_rad, double time_s) {
  double centre_m = 0.0;
  return cover.slack(
      obstacles, position, time_s, 0.0, [&] { return unitVector(psi_rad); }, centre_m);
}

class Search {
 public:
  Search(const State& state, const feasibility::Obstacles& obstacles,
         const vessel::Parameters& vessel, const vessel::Disturbance& disturbance)
      : obstacles_(obstacles),
        vessel_(vessel),
        rest_(vessel, disturbance),
        cover_(vessel.hull),
        fastest_mps_(std::max(vessel.top_speed_mps, vessel::speedOf(state))) {
    motion_.states[0] = state;
    motion_.clear_m = clearanceAt(cover_, obstacles_, state.head<2>(), state[vessel::kPsi], 0.0);
  }

  Escape find() {
    const double ahead = kCarriedShare * vessel_.thrusters.ahead_max_n;
    const double astern = -kCarriedShare * vessel_.thrusters.astern_max_n;
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
    const auto i = static_cast<std::size_t>(k);
    const State& next = motion.states[i + 1] = rest_.after(motion.states[i], thrusts);
    const double clear_m = clearanceAt(cover_, obstacles_, next.head<2>(), next[vessel::kPsi],
                                       (k + 1) * kCarriedStepS);
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
    int last = std::max(pushed_, 1);
    const auto at = [&](int k) { return best_.states[static_cast<std::size_t>(k)]; };
    while (last < kEscapeSteps && !rest_.hasCome(at(last))) {
      ++last;
    }
    std::vector<Piece> pieces;
    pieces.reserve(static_cast<std::size_t>(last));
    for (int k = 0; k < last; ++k) {
      pieces.push_back(carriedPiece(at(k), at(k + 1)));
    }
    if (rest_.hasCome(at(last))) {
      pieces.push_back(stillPiece(at(last)));
    }
    return trajectory::Trajectory(std::move(pieces));
  }

  const feasibility::Obstacles& obstacles_;
  const vessel::Parameters& vessel_;
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
