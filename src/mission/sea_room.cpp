#include "sea_room.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/trajectory/straight_leg.hpp"

namespace otter_nav::mission {

bool SeaRoom::hasALeeShore() const {
  constexpr double kShare = 0.5;  // of the drift: it is seen before it is over
  constexpr int kSteps = 8;
  const Eigen::Vector2d here = moment_.situation.state.head<2>();
  const Eigen::Vector2d drift = kShare * weather().drift();
  for (int k = 0; k <= kSteps; ++k) {
    const double share = static_cast<double>(k) / kSteps;
    const double room_m = (1.5 - 0.5 * share) * hull_.length_m;
    if (clearance(here + share * drift) < room_m) {
      return true;
    }
  }
  return false;
}

double SeaRoom::toLeeward(const Eigen::Vector2d& position, double far_m) const {
  constexpr double kStepM = 0.5;
  const Eigen::Vector2d leeward = weather().drift().normalized();
  double room = 0.0;
  while (room < far_m && clearance(position + (room + kStepM) * leeward) >= safety_.critical()) {
    room += kStepM;
  }
  return std::min(room, far_m);
}

double SeaRoom::toLeeward(const trajectory::TimedTrajectory& path, double ahead_s) const {
  constexpr double kStepS = 1.0;
  const double from = path.elapsed(moment_.now_s);
  const double to = std::min(path.trajectory.duration(), from + ahead_s);
  double room = weather().drift().norm();
  for (double t = from; t < to; t += kStepS) {
    room = toLeeward(path.trajectory.flat(t).position, room);
  }
  return room;
}

double SeaRoom::toMake(int stops, bool to_wait) const {
  struct Wanted {
    double leeward_m, round_m, again_m, round_most_m, farthest_m;
  };
  constexpr Wanted kInWind = {4.0, 1.0, 0.7, 4.0, 6.0};
  constexpr Wanted kInStrongWind = {4.0, 3.0, 0.7, 4.0, 6.0};
  // The hardest gust may be yet to come, and a current carries the hull across it meanwhile.
  constexpr Wanted kToWaitInIt = {8.0, 3.0, 2.0, 9.0, 12.0};
  constexpr double kLeastM = 1.0;  // of drift
  constexpr double kStepM = 0.5;
  constexpr double kWorthM = 0.7;
  constexpr double kIntoCosine = 0.7;
  const bool strong = weather().isStrong();
  const Wanted& wanted = !strong ? kInWind : to_wait ? kToWaitInIt : kInStrongWind;
  const Eigen::Vector2d drift = weather().drift();
  const double far = std::min(drift.norm(), wanted.leeward_m);
  const Eigen::Vector2d place = moment_.situation.state.head<2>();
  const Eigen::Vector2d bow = unitVector(windward());
  const double round = std::min(wanted.round_most_m, wanted.round_m + wanted.again_m * stops);
  const double along = std::abs(bow.dot(drift));
  if (far < kLeastM || along < kIntoCosine * drift.norm()) {
    return 0.0;
  }
  const auto room = [&](const Eigen::Vector2d& position) {
    return toLeeward(position, far) + std::min(clearance(position) - safety_.narrowest(), round);
  };
  // Where a gust sets it aside on the way it goes by nothing that is nearer than what it lies off.
  const double least = strong ? kInStrongWind.round_m : safety_.narrowest();
  const double enough = far + round;
  const double here = clearance(place);
  double best = 0.0;
  double most = room(place) + kWorthM;
  for (const double side : {1.0, -1.0}) {
    double found = 0.0;
    for (double s = kStepM; s <= wanted.farthest_m && most < enough; s += kStepM) {
      const Eigen::Vector2d there = place + side * s * bow;
      if (clearance(there) < std::min(here, least)) {
        break;
      }
      if (room(there) >= most) {
        found = side * s;
        most = room(there) + 0.5 * kStepM;
      }
    }
    best = found != 0.0 ? found : best;
  }
  return best;
}

trajectory::Trajectory SeaRoom::leg(const Eigen::Vector2d& from, double ahead_m) const {
  constexpr double kSpeedMps = 0.5;
  constexpr double kInStrongMps = 1.0;  // with way on it can make good what sets it aside
  constexpr double kLeastS = 4.0;
  const double speed = weather().isStrong() ? kInStrongMps : kSpeedMps;
  return trajectory::Trajectory({trajectory::straightLeg(
      from, windward(), ahead_m, std::max(kLeastS, std::abs(ahead_m) / speed))});
}

double SeaRoom::windward() const {
  constexpr double kTurnMostRad = 0.35;
  const double psi = moment_.situation.state[vessel::kPsi];
  const Eigen::Vector2d& wind = weather().mean().wind_mps;
  const Eigen::Vector2d leeward = wind.isZero(0.0) ? weather().drift() : wind;
  const double to_bow = wrapAngle(angleOf(-leeward) - psi);
  const double turn = std::abs(to_bow) > 0.5 * kPi ? wrapAngle(to_bow + kPi) : to_bow;
  return weather().isStrong() ? psi + std::clamp(turn, -kTurnMostRad, kTurnMostRad) : psi;
}

}  // namespace otter_nav::mission
