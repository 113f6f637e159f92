// Why another plan is asked for though the way ahead is clear: the weather became another, or what
// was made in a hurry, slowly or among others can be bettered. Each is asked for at most so often.
#pragma once

#include <cstddef>
#include <limits>

#include "moment.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "plan_requests.hpp"
#include "safety.hpp"
#include "sailed.hpp"

namespace otter_nav::mission {

// So much more room is worth another plan, m.
constexpr double kMoreRoomM = 0.2;
// And so much beside the hull, in narrow water, on the next stretch.
constexpr double kMoreBesideM = 0.1;
constexpr double kBesideAheadS = 10.0;

// What it is made of outlives it.
class BetterPlans {
 public:
  // The last: one that begins with it.
  enum class For { kThrust, kGusts, kWaves, kRoom, kWideWater, kBeside, kStop };

  BetterPlans(const SupervisorOptions& options, PlanRequests& plans,
              const vessel::Parameters& vessel)
      : options_(options), plans_(plans), vessel_(vessel) {}

  // On the way left the thrusters have not enough against what blows by now, for longer than when
  // it was planned. Once the weather is known, then not for each change again, unless one is being
  // looked for already.
  [[nodiscard]] bool lacksThrust(const Moment& m, const Sailed& sailed, bool is_looked_for) const;
  // At this speed gusts by now take the moment that holds the headings.
  [[nodiscard]] bool isTooFastForGusts(const Moment& m, const Sailed& sailed) const;
  // The way left is faster than the thrust allows that waves leave, by what is known by now: behind
  // such a plan the vessel falls.
  [[nodiscard]] bool isTooFastForWaves(const Moment& m, const Sailed& sailed) const;
  // The plan was made before it showed how far gusts and waves set the vessel aside; or where
  // something far off left no room for all that a lost heading takes to leeward.
  [[nodiscard]] bool passesTooNear(const Moment& m, const Sailed& sailed) const;
  // There was no more room where it began than it keeps all along: what lies ahead it passes nearer
  // than a plan from here may.
  [[nodiscard]] bool passesNearInWideWater(const Moment& m, const Sailed& sailed,
                                           const Eigen::Vector2d& goal) const;
  // Close beside the hull there will be something, which may have come into sight since the plan
  // was made: that keeps well off what is known.
  [[nodiscard]] bool passesNearInNarrowWater(const Moment& m, const Sailed& sailed) const;
  // It ends on a heading that can't be held there, or not on the goal's though it can. What the
  // weather will be later nobody knows.
  [[nodiscard]] bool endsOnAWrongHeading(const Moment& m, const Sailed& sailed,
                                         double goal_psi_rad) const;
  // It was made slow while nobody knew the water or how the vessel wanders; now they do.
  [[nodiscard]] bool isNeedlesslySlow(const Moment& m, const Sailed& sailed) const;
  // A plan from a hull under way leads on in its course, and where that can't be turned, round what
  // lies there.
  [[nodiscard]] bool goesFarRound(const Moment& m, const Sailed& sailed,
                                  const Eigen::Vector2d& goal) const;
  // A plan with rests on its way, or a slow one, was the last resort, and may do with a better one
  // soon.
  [[nodiscard]] bool mayImprove(const Moment& m, const Sailed& sailed) const;

  // The level on which an improvement is looked for: at times the widest.
  void chooseLevelToImprove(const Sailed& sailed);
  // The widest way first; then one like that being sailed, with more beside the hull.
  void chooseWiderLevel(const Sailed& sailed);

  void asked(For what, double now_s) { asked_s_[static_cast<std::size_t>(what)] = now_s; }
  // A plan was taken, or one asked for only to be better.
  void planned(double now_s) { planned_s_ = now_s; }

 private:
  // For that, not so long ago.
  [[nodiscard]] bool wasAsked(For what, double now_s, double within_s) const {
    return now_s - asked_s_[static_cast<std::size_t>(what)] < within_s;
  }
  // At once when the weather is known first, later not before the plan has been sailed a while.
  [[nodiscard]] bool mayReplanForWeather(const Moment& m, const Sailed& sailed) const;
  // The highest speed on the way left, m/s, from where a slower plan could have an effect.
  [[nodiscard]] static double fastestAhead(const Moment& m, const Sailed& sailed);
  // Others drove it to go slowly, though it may be fast: they will have gone soon.
  [[nodiscard]] static bool waitsForOthers(const Moment& m, const Sailed& sailed);
  // Past the narrow place there may be a wider way, to be sailed faster.
  [[nodiscard]] static bool crawlsForRoom(const Sailed& sailed);
  [[nodiscard]] const Weather& weather() const { return plans_.safety.weather(); }

  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  const SupervisorOptions& options_;
  PlanRequests& plans_;
  const vessel::Parameters& vessel_;
  double asked_s_[7] = {kNever, kNever, kNever, kNever, kNever, kNever, kNever};  // last, for what
  double planned_s_ = 0.0;
  bool asks_widest_ = true;  // next
};

}  // namespace otter_nav::mission
