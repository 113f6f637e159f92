// What plans keep to: clearance and thrust, made here once for each request from the vessel, the
// mission's options, the weather and what was learned on the way. Nobody below adds to it.
#pragma once

#include <cstddef>

#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::mission {

// Of the hull's centre, m: `beside_m` more than half the beam.
[[nodiscard]] inline double centreClearance(const vessel::Hull& hull, double beside_m) {
  return 0.5 * hull.beam_m + beside_m;
}

// `disturbance_n` over the thrust of both propellers full ahead.
[[nodiscard]] double disturbanceShare(double disturbance_n, const vessel::Thrusters& thrusters);

// Of the limits, for a plan; in steps of 0.05. Less by twice the disturbance's share (its moment
// and its gusts ask for some as well) and by 0.1 each time the vessel couldn't follow, but never
// less than 0.4.
[[nodiscard]] double planThrustShare(double share_in_calm, double disturbance_share,
                                     int times_left_behind);

// The clearance that `level` of the options' list asks for, m. The levels lie further apart in
// wind: gusts carry the vessel off its path by as much. Against a force from the side the hull goes
// crabwise and reaches further to both sides: the narrowest grows by that. Not more than start and
// goal have (`room_m`), unless the list itself asks for it.
[[nodiscard]] double planClearance(const SupervisorOptions& options, std::size_t level,
                                   double disturbance_share, double thrust_share,
                                   const vessel::Hull& hull, double room_m);

// The clearances of the list in turn, from the widest to the narrowest and round again.
class ClearanceLevels {
 public:
  explicit ClearanceLevels(std::size_t count) : count_(count) {}
  [[nodiscard]] std::size_t level() const { return level_; }
  [[nodiscard]] bool atNarrowest() const { return level_ + 1 >= count_; }
  // False where it begins again at the widest.
  bool narrower() {
    const bool last = atNarrowest();
    level_ = last ? 0 : level_ + 1;
    return !last;
  }
  void widest() { level_ = 0; }

 private:
  std::size_t count_;
  std::size_t level_ = 0;
};

class Safety {
 public:
  Safety(const SupervisorOptions& options, const vessel::Parameters& vessel);

  // Clearances of the hull's centre, m: no plan is made with less than the narrowest, and the
  // vessel brakes for less than the critical one.
  [[nodiscard]] double narrowest() const;
  [[nodiscard]] double critical() const;

  // The next request's limits: of the first level from the present one on that start and goal have
  // room for, and with `thrust_share`.
  [[nodiscard]] feasibility::SafetyLimits limits(double thrust_share, double room_m);

  // What wind and current and the vessel's troubles leave for plans.
  [[nodiscard]] double freeThrustShare() const;
  // For a plan from the vessel as it moves: one too fast for the thrust that plans should keep to
  // gets a plan with more rather than none.
  [[nodiscard]] double movingThrustShare() const;
  [[nodiscard]] bool countsOnTooMuch(double planned_share) const;

  void newGoal();                   // forgets what happened on the way to the one before
  void feel(double disturbance_n);  // the force of wind and current, as estimated
  void leftBehind() { ++times_left_behind_; }
  // A plan failed: the next is tried narrower; false where all levels were tried.
  bool refused(bool from_vessel);
  void planTaken();
  void tryWidest() { levels_.widest(); }

 private:
  SupervisorOptions options_;
  vessel::Parameters vessel_;
  ClearanceLevels levels_;
  double disturbance_share_ = 0.0;  // of the thrust ahead
  int times_refused_ = 0;           // at all levels, from where the vessel is, in a row
  int times_left_behind_ = 0;       // on the way to this goal
};

}  // namespace otter_nav::mission
