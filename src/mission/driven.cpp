#include "driven.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "otter_nav/stopping/back_off.hpp"
#include "sea_room.hpp"

namespace otter_nav::mission {

bool Driven::liesOffALeeShore(const Moment& m, int stops, bool to_wait) {
  constexpr double kShorterM = 0.5;
  const feasibility::Obstacles now = m.obstacles.startingAt(m.now_s);
  room_m_ =
      safety_.weather().isKnown() ? SeaRoom(m, safety_, vessel_.hull).toMake(stops, to_wait) : 0.0;
  // The bow comes farther than the centre, and something may move.
  while (room_m_ != 0.0 && !stopping::backOffIsClear(legToMakeIt(m), 0.0, now, vessel_)) {
    room_m_ = std::copysign(std::max(0.0, std::abs(room_m_) - kShorterM), room_m_);
  }
  return room_m_ != 0.0;
}

trajectory::Trajectory Driven::legToMakeIt(const Moment& m) const {
  return SeaRoom(m, safety_, vessel_.hull).leg(withoutSwing(m).head<2>(), room_m_);
}

bool Driven::isDrivenOntoSomething(const Moment& m, const Sailed& sailed, Lies lies) {
  constexpr double kWithinS = 5.0;
  constexpr double kNearM = 1.0;
  constexpr double kNearOnItsWayM = 0.1;
  constexpr double kNearerM = 0.5;  // than it lies
  constexpr double kWorthM = 0.7;
  constexpr double kDriftsS = 10.0;
  constexpr double kDriftsOntoM = 0.3;
  constexpr double kAgainS = 0.2;
  constexpr double kAnotherS = 60.0;
  const vessel::Foreseen& foreseen = m.situation.foreseen;
  const bool may_lose_heading = safety_.weather().isNearlyStrong();
  const bool again_soon = may_lose_heading || lies == Lies::kEscaping;
  if (!(may_lose_heading || safety_.plansWithWeather()) || foreseen.start_s < sailed.given_s ||
      m.now_s - escaped_s_ < (again_soon ? kAgainS : kAnotherS)) {
    return false;
  }
  const vessel::State& x = m.situation.state;
  const vessel::Foreseen here{m.now_s, 0.0, {{x.head<2>(), x[vessel::kPsi]}}};
  const auto least = [&](const vessel::Foreseen& motion, double within_s) {
    return stopping::leastClearance(motion, m.now_s, m.now_s + within_s, m.obstacles, vessel_.hull);
  };
  const bool off_plans = may_lose_heading && lies != Lies::kOnItsWay;
  double comes_m = least(foreseen, kWithinS);
  if (off_plans && lies != Lies::kEscaping) {
    const double drifts_m = least(stopping::driftingOn(foreseen, m.now_s + kDriftsS), kDriftsS);
    comes_m = drifts_m < kDriftsOntoM ? std::min(comes_m, drifts_m) : comes_m;
  }
  const double near_m = off_plans ? kNearM : kNearOnItsWayM;
  if (comes_m > std::min(near_m, least(here, kWithinS) - kNearerM)) {
    return false;
  }
  escape_ =
      stopping::escape(x, m.obstacles.startingAt(m.now_s), vessel_, m.situation.disturbance.mean);
  return escape_.clearance_m > comes_m + kWorthM;
}

trajectory::Trajectory Driven::takeEscape(double now_s) {
  escaped_s_ = now_s;
  return std::move(escape_.path);
}

}  // namespace otter_nav::mission
