#include "arrival.hpp"

#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/text.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::mission {
namespace {

constexpr double kSettleS = 10.0;  // at a trajectory's end

}  // namespace

double Arrival::distance() const {
  return (moment_.situation.state.head<2>() - goal_.position).norm();
}

double Arrival::headingOff() const {
  return std::abs(wrapAngle(moment_.situation.state[vessel::kPsi] - goal_.psi_rad));
}

bool Arrival::liesAtTheGoal() const {
  return distance() <= options_.arrival_distance_m &&
         vessel::speedOf(moment_.situation.state) <= vessel::kRestMps;
}

bool Arrival::isThere() const {
  return liesAtTheGoal() && (headingOff() <= options_.arrival_heading_rad || goalHeadingYields());
}

bool Arrival::hasArrived() const {
  return sailed_.isAtTheEnd(moment_.now_s) &&
         (isThere() || (liesAtTheGoal() && doesNotComeRound()));
}

bool Arrival::doesNotComeRound() const {
  return weather().isStrong() && sailed_.path.left(moment_.now_s) <= -kSettleS &&
         headingOff() > 0.5 * kPi && safety_.isHeldInWind(moment_.situation.state[vessel::kPsi]);
}

bool Arrival::settlesNoMore() const {
  constexpr double kElsewhereM = 0.5;
  if (!sailed_.isAtTheEnd(moment_.now_s)) {
    return false;
  }
  const trajectory::Trajectory& path = sailed_.path.trajectory;
  return sailed_.path.left(moment_.now_s) <= -kSettleS ||
         ((path.flat(path.duration()).position - goal_.position).norm() > kElsewhereM &&
          atRest(moment_.situation.state));
}

bool Arrival::goalHeadingYields() const {
  constexpr double kSameRad = 1e-3;
  return weather().isKnown() &&
         (std::abs(wrapAngle(safety_.restHeading(goal_.psi_rad) - goal_.psi_rad)) > kSameRad ||
          staysOffGoalHeading());
}

bool Arrival::staysOffGoalHeading() const {
  const double planned_rad = sailed_.plan.goal_psi_rad;
  return weather().isStrong() &&
         std::abs(wrapAngle(planned_rad - goal_.psi_rad)) > options_.arrival_heading_rad &&
         vessel::canLie(vessel_.manoeuvring, weather().mean(), planned_rad);
}

std::string Arrival::whyOffHeading() const {
  if (headingOff() <= options_.arrival_heading_rad) {
    return {};
  }
  const std::string off =
      text("%.2f m from the goal (%.2f m allowed), but %.2f rad off its heading: ", distance(),
           options_.arrival_distance_m, headingOff());
  if (!goalHeadingYields()) {
    return off + text("the wind takes %.0f N m of the %.0f N m that turn the hull round",
                      weather().greatestMoment(), vessel::greatestMoment(vessel_.thrusters));
  }
  const bool in_gusts = weather().isStrong();
  const vessel::Disturbance load = in_gusts ? weather().gust() : weather().mean();
  return off +
         text("wind and current would set the vessel aside by %.2f m/s on it",
              vessel::setAside(vessel_.manoeuvring, load, goal_.psi_rad)) +
         (in_gusts ? " in gusts" : "");
}

}  // namespace otter_nav::mission
