// What plans keep to: clearance and thrust, made here once for each request from the vessel, the
// mission's options, the weather and what was learned on the way. Nobody below adds to it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/stopping/braking.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "wander.hpp"
#include "weather.hpp"

namespace otter_nav::mission {

// Of the hull's centre, m: `beside_m` more than half the beam.
[[nodiscard]] inline double centreClearance(const vessel::Hull& hull, double beside_m) {
  return 0.5 * hull.beam_m + beside_m;
}

// Of the limits, for a plan; in steps of 0.05. What gusts take (`gust_share`) is left over, and 0.1
// more each time the vessel couldn't follow; but never less than 0.4. What wind and current take on
// the whole is the plan's own to find thrust for; for still water up to a tenth is left
// over too.
[[nodiscard]] double planThrustShare(double share_in_calm, double gust_share,
                                     int times_left_behind);

// The clearance that `level` of the options' list asks for, m: so much beside what gusts move the
// tracked hull by (`gust_reach_m`; three quarters of that on the third level, half from the fourth
// on). Not more than start and goal have (`room_m`), unless the list itself asks for it.
[[nodiscard]] double planClearance(const SupervisorOptions& options, std::size_t level,
                                   double gust_reach_m, const vessel::Hull& hull, double room_m);

// The clearances of the list in turn, from the widest to the narrowest and round again; or in steps
// between them, for in strong wind one level asks for metres less than the one before.
class ClearanceLevels {
 public:
  static constexpr int kSteps = 3;  // from one level to the next

  explicit ClearanceLevels(std::size_t count) : count_(count) {}
  [[nodiscard]] std::size_t level() const { return level_; }
  // So many steps wider than the level, towards the one before; less than `kSteps`.
  [[nodiscard]] int stepsWider() const { return steps_wider_; }
  [[nodiscard]] bool atNarrowest() const { return level_ + 1 >= count_ && steps_wider_ == 0; }
  // False where it begins again at the widest.
  bool narrower(bool in_steps) {
    if (atNarrowest()) {
      widest();
      return false;
    }
    if (steps_wider_ > 0) {
      --steps_wider_;
    } else {
      ++level_;
      steps_wider_ = in_steps ? kSteps - 1 : 0;
    }
    return true;
  }
  void widest() { begin(0); }
  void begin(std::size_t level, int steps_wider = 0) {
    level_ = std::min(level, count_ - 1);
    steps_wider_ = steps_wider;
  }

 private:
  std::size_t count_;
  std::size_t level_ = 0;
  int steps_wider_ = 0;
};

class Safety {
 public:
  Safety(const SupervisorOptions& options, const vessel::Parameters& vessel);

  // Of the hull's centre, m: no plan is made with less.
  [[nodiscard]] double narrowest() const;
  // The same of plans on the widest level in calm weather.
  [[nodiscard]] double widest() const;
  // Of the hull's outline in its planned attitude, m: with less the vessel looks for another way.
  [[nodiscard]] double critical() const { return options_.critical_side_clearance_m; }
  // What a stop should keep, from a trajectory planned to these limits; and what every stop keeps.
  [[nodiscard]] stopping::StopLimits stop(const feasibility::SafetyLimits& planned) const;
  [[nodiscard]] stopping::StopLimits leastStop(const feasibility::SafetyLimits& planned) const;

  // To the first level from the present one on that start and goal have room for; whether that is
  // another.
  bool narrowTo(double room_m);
  // The next request's limits: of that level, and with `thrust_share`. From rest the last round
  // leaves aside that the hull leans; a vessel under way can stop first.
  [[nodiscard]] feasibility::SafetyLimits limits(double thrust_share, double room_m,
                                                 bool under_way = false);

  // What the next plan is made with; the state it starts from has to be one under that too.
  [[nodiscard]] vessel::Disturbance planDisturbance() const;
  // What wind and current and the vessel's troubles leave for plans.
  [[nodiscard]] double freeThrustShare() const;
  // The speed through the water, m/s, that waves leave the thrust for.
  [[nodiscard]] double speedInWaves() const;
  // The share that calm water leaves.
  [[nodiscard]] double calmThrustShare() const { return options_.thrust_share; }
  // For the next plan: where there was none with that, one with more rather than none.
  [[nodiscard]] double nextThrustShare() const;
  // Where there is none that knows of wind and current even so, one that leaves thrust for them
  // instead is better than none.
  [[nodiscard]] bool plansBlind() const;

  // What gusts leave of the speed that plans usually have, m/s. A load that doesn't turn with the
  // heading leaves all of it: a slower hull would only be carried.
  [[nodiscard]] double sailingSpeed(double usual_mps) const;
  // Of the speed that plans may usually have: what can't be planned fast may be planned slow.
  [[nodiscard]] double slowShare() const;
  // Whether headings can be held at a crawl, whatever they are.
  [[nodiscard]] bool mayCreep() const;
  // `usual_mps`, or a crawl where the vessel wanders by most of the room that a level has: at speed
  // it would be farther off its way.
  [[nodiscard]] double paceAt(std::size_t level, double usual_mps) const;
  // Little more than that crawl, m/s, where the vessel was seen to wander so: a plan that begins
  // faster sails the narrow water with it before it has slowed down. Else anything.
  [[nodiscard]] double fastestStart(std::size_t level) const;

  void setOptions(const SupervisorOptions& options) { options_ = options; }
  // Of all plans from now on; 0: the vessel's alone.
  void setSpeedMax(double speed_mps) { options_.speed_max_mps = speed_mps; }
  [[nodiscard]] double speedMax() const { return options_.speed_max_mps; }

  // A goal's heading, or where that can't be held the one into what wind and current push with.
  [[nodiscard]] double restHeading(double psi_rad) const;
  // Whether plans are made with the weather where that is a firm load. One that turns with the
  // heading leaves no plan in a fresh wind (docs/weather.md).
  [[nodiscard]] bool mayPlanWithWeather() const;
  // And it is: plans begin and end bow to it. In a light load those for still water do better.
  [[nodiscard]] bool plansWithWeather() const;
  // From `psi_rad` to the heading that a plan from rest begins on; 0 in a light load.
  [[nodiscard]] double turnIntoLoad(double psi_rad) const;
  // Bow or stern to the wind, nearly: where its moment is small.
  [[nodiscard]] bool isHeldInWind(double psi_rad) const;
  // Why no leg can be sailed nor a spot be held in this weather; empty if that's not so.
  [[nodiscard]] std::string beyondThrust() const;

  void newGoal();  // forgets what happened on the way to the one before
  // What wind and current are estimated to be.
  void feel(double now_s, const vessel::Disturbance& estimate);
  [[nodiscard]] const Weather& weather() const { return weather_; }
  // The vessel's sway beside its trajectory's, m/s.
  void feelSway(double now_s, double off_mps) { weather_.feelSway(now_s, off_mps); }
  // How far the vessel is off its trajectory.
  void wander(double now_s, double off_m) { wander_.feel(now_s, off_m); }
  // What it needs around it for that, m, where there is room.
  [[nodiscard]] double reach() const;
  // Whether there is water near that nobody has seen or charted.
  void inUnknownWater(bool is) { in_unknown_water_ = is; }
  [[nodiscard]] bool isInUnknownWater() const { return in_unknown_water_; }
  void leftBehind(double now_s);
  // A plan failed: the next is tried narrower; false where all levels were tried.
  bool refused();
  // At all levels; for blind plans, since they are.
  [[nodiscard]] int timesRefused() const;
  // The first refusal at all levels was of plans with more around the hull than the next will keep.
  [[nodiscard]] bool mayKeepLess() const;
  void planTaken();
  void tryWidest() { levels_.widest(); }
  // The vessel came to rest: what was refused under way is another matter from here.
  void comeToRest();
  [[nodiscard]] std::size_t level() const { return levels_.level(); }
  [[nodiscard]] bool atNarrowest() const { return levels_.atNarrowest(); }
  // Of `ClearanceLevels`.
  [[nodiscard]] int stepsWider() const { return levels_.stepsWider(); }
  void tryLevel(std::size_t level, int steps_wider = 0) { levels_.begin(level, steps_wider); }

 private:
  // At less a light load from abeam turns a hull that keeps to its path by more than a little.
  [[nodiscard]] double leastPace() const;
  // What the hull leans into on the way and plans are not made with.
  [[nodiscard]] vessel::Disturbance leansInto() const;
  [[nodiscard]] bool liesOnAnyHeading() const;  // in that
  // The same where it can.
  [[nodiscard]] vessel::Disturbance lightLoad() const;
  // Of the thrust, what waves take from plans on this level.
  [[nodiscard]] double waveShare() const;
  // Around the hull, m, after so many refusals.
  [[nodiscard]] double hullMargin(std::size_t level, int times_refused) const;
  // Of the hull's centre where it costs little, m.
  [[nodiscard]] double preferredClearance() const;
  // What room that takes, m.
  [[nodiscard]] double wandersAt(std::size_t level) const;
  [[nodiscard]] bool wandersMuch(std::size_t level) const;

  SupervisorOptions options_;
  vessel::Parameters vessel_;
  ClearanceLevels levels_;
  Weather weather_;
  Wander wander_;
  bool in_unknown_water_ = false;
  bool is_slow_ = false;       // what was asked for last
  int times_refused_ = 0;      // at all levels, from where the vessel is, in a row
  int times_left_behind_ = 0;  // on the way to this goal, and not long ago
  double left_behind_s_ = 0.0;
};

}  // namespace otter_nav::mission
