#include "better_plans.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "otter_nav/base/angles.hpp"
#include "sea_room.hpp"
#include "way_ahead.hpp"

namespace otter_nav::mission {

bool BetterPlans::mayReplanForWeather(const Moment& m, const Sailed& sailed) const {
  constexpr double kAgainS = 10.0;
  return weather().isKnown() && (!sailed.plan.in_known_weather || m.now_s - planned_s_ >= kAgainS);
}

bool BetterPlans::lacksThrust(const Moment& m, const Sailed& sailed, bool is_looked_for) const {
  constexpr double kAgainS = 5.0;
  return mayReplanForWeather(m, sailed) &&
         (is_looked_for || !wasAsked(For::kThrust, m.now_s, kAgainS)) &&
         overtaxed(m.now_s, sailed.path, vessel_, weather().mean()) >
             sailed.plan.overtaxed_s + kOvertaxedLongerS;
}

bool BetterPlans::isTooFastForGusts(const Moment& m, const Sailed& sailed) const {
  constexpr double kAgainS = 10.0;
  constexpr double kWorthShare = 0.7;  // of the speed: slowing down for less isn't worth it
  constexpr double kLeftS = 5.0;
  const double planned_mps = sailed.plan.limits.speed_max_mps;
  return mayReplanForWeather(m, sailed) && !wasAsked(For::kGusts, m.now_s, kAgainS) &&
         sailed.path.left(m.now_s) > kLeftS &&
         plans_.safety.sailingSpeed(planned_mps) < kWorthShare * planned_mps;
}

// A plan that begins above its limit slows down after a while: asked for again before, it never
// would.
bool BetterPlans::isTooFastForWaves(const Moment& m, const Sailed& sailed) const {
  constexpr double kAgainS = 2.0;
  constexpr double kWorthShare = 0.93;  // of the speed: slowing down for less isn't worth it
  constexpr double kLeftS = 4.0;
  return weather().knowsWaves() && !wasAsked(For::kWaves, m.now_s, kAgainS) &&
         sailed.path.left(m.now_s) > kLeftS &&
         plans_.safety.speedInWaves() <
             kWorthShare * std::min(fastestAhead(m, sailed), sailed.plan.limits.speed_max_mps);
}

double BetterPlans::fastestAhead(const Moment& m, const Sailed& sailed) {
  constexpr double kStepS = 0.5;
  constexpr double kAheadS = 20.0;
  const trajectory::Trajectory& path = sailed.path.trajectory;
  const double from = sailed.path.elapsed(m.now_s) + 1.0;
  const double to = std::min(path.duration(), from + kAheadS);
  double fastest = 0.0;
  for (double t = from; t < to; t += kStepS) {
    fastest = std::max(fastest, path.flat(t).velocity.norm());
  }
  return fastest;
}

bool BetterPlans::passesTooNear(const Moment& m, const Sailed& sailed) const {
  constexpr double kAgainS = 5.0;
  constexpr double kLeftS = 4.0;
  constexpr double kShare = 0.85;  // for a little more it is not worth another plan
  constexpr double kAheadS = 30.0;
  const Safety& safety = plans_.safety;
  if (wasAsked(For::kRoom, m.now_s, kAgainS) || sailed.path.left(m.now_s) <= kLeftS) {
    return false;
  }
  if (safety.plansWithWeather()) {
    return !WayAhead(m, safety, vessel_, sailed).leavesRoomOn(sailed.path, kShare, kAheadS);
  }
  return weather().isStrong() && sailed.plan.level > 0 &&
         SeaRoom(m, safety, vessel_.hull).toLeeward(sailed.path, kAheadS) <
             kShare * weather().drift().norm();
}

bool BetterPlans::passesNearInWideWater(const Moment& m, const Sailed& sailed,
                                        const Eigen::Vector2d& goal) const {
  constexpr double kAgainS = 2.0;
  constexpr double kLeftS = 4.0;
  if (sailed.plan.level == 0 || sailed.plan.among_others || sailed.plan.in_unknown_water ||
      plans_.safety.plansWithWeather() || wasAsked(For::kWideWater, m.now_s, kAgainS) ||
      sailed.path.left(m.now_s) <= kLeftS) {
    return false;
  }
  const map::DistanceField& field = m.obstacles.field();
  const double wide_m = plans_.safety.widest();
  const double starts_s = m.now_s + plans_.latency.seconds();
  return std::min(field.clearance(sailed.at(starts_s).position), field.clearance(goal)) > wide_m &&
         WayAhead(m, plans_.safety, vessel_, sailed).leastRoom(sailed.path, starts_s) <
             wide_m - kMoreRoomM;
}

bool BetterPlans::passesNearInNarrowWater(const Moment& m, const Sailed& sailed) const {
  constexpr double kAgainS = 1.0;
  constexpr double kLeftS = 4.0;
  if (sailed.plan.among_others || plans_.safety.plansWithWeather() ||
      wasAsked(For::kBeside, m.now_s, kAgainS) || sailed.path.left(m.now_s) <= kLeftS) {
    return false;
  }
  return !WayAhead(m, plans_.safety, vessel_, sailed)
              .keepsBeside(sailed.path, m.now_s + plans_.latency.seconds(), kBesideAheadS,
                           feasibility::kPreferredBesideM - kMoreBesideM);
}

bool BetterPlans::endsOnAWrongHeading(const Moment& m, const Sailed& sailed,
                                      double goal_psi_rad) const {
  constexpr double kWrongRad = 0.7;
  constexpr double kLeftS = 5.0;
  constexpr double kSoonS = 30.0;
  const double left_s = sailed.path.left(m.now_s);
  return mayReplanForWeather(m, sailed) && left_s > kLeftS &&
         (left_s < kSoonS || !sailed.plan.in_known_weather) &&
         std::abs(wrapAngle(plans_.safety.restHeading(goal_psi_rad) - sailed.plan.goal_psi_rad)) >
             kWrongRad;
}

bool BetterPlans::isNeedlesslySlow(const Moment& m, const Sailed& sailed) const {
  constexpr double kAgainS = 1.0;
  constexpr double kLeftS = 4.0;
  return m.now_s - planned_s_ >= kAgainS && sailed.path.left(m.now_s) > kLeftS &&
         plans_.mayBeFaster(sailed.plan.level, sailed.plan.pace_share, m.situation.state,
                            m.obstacles);
}

bool BetterPlans::goesFarRound(const Moment& m, const Sailed& sailed,
                               const Eigen::Vector2d& goal) const {
  constexpr double kTimesStraight = 2.0;
  constexpr double kMoreM = 30.0;
  constexpr double kAgainS = 10.0;
  const double straight_m = (goal - m.situation.state.head<2>()).norm();
  return !wasAsked(For::kStop, m.now_s, kAgainS) && !weather().isStrong() &&
         !plans_.safety.plansWithWeather() &&
         sailed.wayLeft(m.now_s) > kTimesStraight * straight_m + kMoreM;
}

bool BetterPlans::mayImprove(const Moment& m, const Sailed& sailed) const {
  constexpr double kLastResortS = 1.0;
  constexpr double kPartS = 2.0;  // what leads a part of the way
  constexpr double kCrawlingS = 2.0;
  constexpr double kCrowdedS = 3.0;
  const double since_s = m.now_s - planned_s_;
  const double last_resort = sailed.plan.left_m > 0.0 ? kPartS : kLastResortS;
  const bool others_slow_it = since_s >= kCrowdedS && waitsForOthers(m, sailed);
  const double usual = crawlsForRoom(sailed) ? kCrawlingS
                       : others_slow_it      ? kCrowdedS
                                             : options_.improve_period_s;
  const double period = sailed.plan.is_last_resort ? last_resort : usual;
  return period > 0.0 && since_s >= period && sailed.path.left(m.now_s) > period;
}

bool BetterPlans::waitsForOthers(const Moment& m, const Sailed& sailed) {
  constexpr double kLonger = 1.8;
  constexpr double kSpareS = 5.0;
  if (!sailed.plan.among_others) {
    return false;
  }
  const double at_most_m =
      sailed.plan.limits.speed_max_mps * (sailed.path.left(m.now_s) - kSpareS) / kLonger;
  return at_most_m > sailed.wayLeft(m.now_s);
}

bool BetterPlans::crawlsForRoom(const Sailed& sailed) {
  return sailed.plan.pace_share < 1.0 && sailed.plan.level > 0 && !sailed.plan.in_unknown_water;
}

void BetterPlans::chooseLevelToImprove(const Sailed& sailed) {
  if (sailed.plan.is_last_resort) {
    plans_.safety.tryLevel(sailed.plan.level);
  } else if (crawlsForRoom(sailed)) {
    plans_.safety.tryLevel(std::exchange(asks_widest_, !asks_widest_) ? 0 : sailed.plan.level - 1);
  }
}

void BetterPlans::chooseWiderLevel(const Sailed& sailed) {
  const std::size_t level = sailed.plan.level;
  const std::size_t like_it = plans_.safety.plansWithWeather() || level == 0 ? level : level - 1;
  plans_.safety.tryLevel(std::exchange(asks_widest_, !asks_widest_) ? 0 : like_it);
}

}  // namespace otter_nav::mission
