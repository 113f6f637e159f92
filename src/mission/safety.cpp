#include "safety.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/text.hpp"
#include "otter_nav/vessel/crawl.hpp"
#include "otter_nav/vessel/hull.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::mission {
namespace {

constexpr double kLeastThrustShare = 0.4;
constexpr double kLessThrust = 0.1;  // each time the vessel couldn't follow
constexpr int kRefusedMost = 2;
constexpr std::size_t kLevelsInLoad = 2;
constexpr double kMoreThrust = 0.2;  // each time there was no plan at any clearance
// Around the discs that cover the hull, at least. A plan keeps a little more than a stop, so that
// what the map adds by cells on the way leaves the stops clear.
constexpr double kPlanMarginM = 0.05;
constexpr double kOffTrajectoryM = 0.02;
// Among what nobody has charted, where turns and stops come when they must, at first.
constexpr double kUnknownMarginM = 0.1;
// What it wanders may take so much of the room at the usual pace; less before it goes at that
// again, for the faster it goes the more it wanders, and a plan for each pace in turn leads it
// aground.
constexpr double kMostOfRoom = 0.75;
constexpr double kMostToGoFaster = 0.6;
// Of what it wanders, kept on the narrow levels too; and what it is expected to where it was not
// under way for long enough to tell.
constexpr double kWanderM = 0.2;
// Among what nobody has charted plans keep so many times what it wanders on all levels but the
// narrowest, as far as these have room for it, for what comes into sight takes some.
constexpr double kTimesWander = 2.0;
// At the usual speed waves set the corners aside by so much more than the hull wanders at a crawl:
// what counts on the narrow levels.
constexpr double kTimesAtSpeed = 1.75;

}  // namespace

double planThrustShare(double share_in_calm, double gust_share, int times_left_behind) {
  constexpr double kStep = 0.05;
  const double share = std::min(share_in_calm, 1.0 - gust_share) - times_left_behind * kLessThrust;
  return std::max(kLeastThrustShare, kStep * std::floor(share / kStep + 1e-9));
}

double planClearance(const SupervisorOptions& options, std::size_t level, double gust_reach_m,
                     const vessel::Hull& hull, double room_m) {
  const double listed = centreClearance(hull, options.side_clearances_m[level]);
  constexpr double kShares[] = {1.0, 1.0, 0.75, 0.5};  // of the reach; the last for all that follow
  const double aside = kShares[std::min(level, std::size(kShares) - 1)] * gust_reach_m;
  // At the ends themselves something has to be left.
  constexpr double kLessM = 0.1;
  return std::min(listed + aside, std::max(listed, room_m - kLessM));
}

Safety::Safety(const SupervisorOptions& options, const vessel::Parameters& vessel)
    : options_(options),
      vessel_(vessel),
      levels_(options.side_clearances_m.size()),
      weather_(vessel) {}

double Safety::narrowest() const {
  return centreClearance(vessel_.hull, options_.side_clearances_m.back());
}

double Safety::widest() const {
  return centreClearance(vessel_.hull, options_.side_clearances_m.front());
}

stopping::StopLimits Safety::stop(const feasibility::SafetyLimits& planned) const {
  stopping::StopLimits limits = leastStop(planned);
  limits.hull_margin_m =
      std::max(kOffTrajectoryM, planned.hull_margin_m - (kPlanMarginM - kOffTrajectoryM));
  return limits;
}

stopping::StopLimits Safety::leastStop(const feasibility::SafetyLimits& planned) const {
  stopping::StopLimits limits;
  limits.clearance_m = centreClearance(vessel_.hull, options_.critical_side_clearance_m);
  limits.hull_margin_m = kOffTrajectoryM;
  limits.disturbance = planned.disturbance;
  limits.felt = planned.felt;
  limits.rest_room_m = std::min(stopping::kSwingsM, kTimesWander * reach());
  limits.rest_load = weather_.isKnown() ? weather_.mean() : vessel::Disturbance{};
  return limits;
}

bool Safety::narrowTo(double room_m) {
  bool narrows = false;
  while (!levels_.atNarrowest() &&
         centreClearance(vessel_.hull, options_.side_clearances_m[levels_.level()]) > room_m) {
    levels_.begin(levels_.level() + 1);
    narrows = true;
  }
  return narrows;
}

feasibility::SafetyLimits Safety::limits(double thrust_share, double room_m, bool under_way) {
  (void)narrowTo(room_m);
  const double wider = levels_.stepsWider() / static_cast<double>(ClearanceLevels::kSteps);
  const auto between = [&](const auto& of_level) {
    const double at = of_level(levels_.level());
    return wider > 0.0 ? at + wider * (of_level(levels_.level() - 1) - at) : at;
  };
  const double clearance = between([&](std::size_t level) {
    return planClearance(options_, level, weather_.gustReach(), vessel_.hull, room_m);
  });
  auto limits = feasibility::SafetyLimits::of(vessel_, clearance, thrust_share);
  limits.preferred_clearance_m = preferredClearance();
  limits.speed_max_mps = sailingSpeed(limits.speed_max_mps);
  constexpr double kLeeShares[] = {1.0, 0.5, 0.25, 0.1};  // by level
  limits.drift_m = between([&](std::size_t level) {
                     return kLeeShares[std::min(level, std::size(kLeeShares) - 1)];
                   }) *
                   weather_.drift();
  limits.disturbance = planDisturbance();
  if (under_way || timesRefused() < kRefusedMost) {
    limits.felt = leansInto();
  }
  limits.hull_margin_m = hullMargin(levels_.level(), times_refused_);
  limits.limitSpeed(options_.speed_max_mps);
  limits.speed_max_mps = paceAt(levels_.level(), limits.speed_max_mps * slowShare());
  is_slow_ = wandersMuch(levels_.level());
  return limits;
}

// Where the wind takes much of the moment that holds headings, the hull may lie in any, and be set
// aside by what gusts do: wide water is used where there is some.
double Safety::preferredClearance() const {
  if (!weather_.isKnown() || !weather_.isNearlyStrong()) {
    return 0.0;
  }
  constexpr double kAnyRoomM = std::numeric_limits<double>::infinity();
  const double reach_m = std::min(weather_.gustReach(), vessel_.hull.length_m);
  return planClearance(options_, 0, reach_m, vessel_.hull, kAnyRoomM) +
         vessel::circumscribedRadius(vessel_.hull) - 0.5 * vessel_.hull.beam_m;
}

// What it wanders, as far as the level has room for it; half as much each time there was no plan.
double Safety::hullMargin(std::size_t level, int times_refused) const {
  const double most = std::max(kWanderM, options_.side_clearances_m[level]);
  const double least = in_unknown_water_ ? kUnknownMarginM : 0.0;
  return std::max(kPlanMarginM,
                  std::pow(0.5, times_refused) * std::clamp(wandersAt(level), least, most));
}

bool Safety::mayKeepLess() const {
  const std::size_t narrowest = options_.side_clearances_m.size() - 1;
  return times_refused_ == 1 && hullMargin(narrowest, 1) < hullMargin(narrowest, 0);
}

double Safety::wandersAt(std::size_t level) const {
  const double side_m = options_.side_clearances_m[level];
  if (side_m <= kWanderM && !wander_.isKnown()) {
    return std::max(kWanderM, reach());  // by more than there is room for, until it shows
  }
  return (in_unknown_water_ && side_m >= kWanderM ? kTimesWander : 1.0) * reach();
}

bool Safety::wandersMuch(std::size_t level) const {
  const double side_m = options_.side_clearances_m[level];
  const double times = side_m <= kWanderM ? kTimesAtSpeed : 1.0;
  const double most = is_slow_ ? kMostToGoFaster : kMostOfRoom;
  return std::max(wandersAt(level), times * reach()) > most * side_m;
}

double Safety::paceAt(std::size_t level, double usual_mps) const {
  if (plansWithWeather() || !wandersMuch(level)) {
    return usual_mps;
  }
  return std::min(usual_mps, std::max(vessel::crawlMps(vessel_.hull), leastPace()));
}

double Safety::fastestStart(std::size_t level) const {
  constexpr double kFaster = 1.25;
  constexpr double kAnyPaceMps = std::numeric_limits<double>::infinity();
  return wander_.isKnown() ? kFaster * paceAt(level, kAnyPaceMps) : kAnyPaceMps;
}

double Safety::leastPace() const {
  constexpr double kLeanRad = 0.25;
  return vessel::InverseDynamics(vessel_, lightLoad()).greatestLoadAbeam() /
         (std::tan(kLeanRad) * vessel_.paper.d2_kgps);
}

double Safety::sailingSpeed(double usual_mps) const {
  return !weather_.isKnown() || mayPlanWithWeather() ? usual_mps : weather_.sailingSpeed(usual_mps);
}

double Safety::reach() const {
  // Gusts come with a firm load, and corrections among what nobody has charted.
  const bool expects_it = in_unknown_water_ || plansWithWeather();
  return expects_it && !wander_.isKnown() ? std::max(kWanderM, wander_.reach()) : wander_.reach();
}

bool Safety::mayPlanWithWeather() const {
  return options_.plan_with_weather && !vessel_.manoeuvring.feelsWind();
}

bool Safety::plansWithWeather() const {
  return mayPlanWithWeather() && weather_.isKnown() && vessel::isFirmLoad(vessel_, weather_.mean());
}

vessel::Disturbance Safety::leansInto() const {
  const bool is_known_to_plans = plansWithWeather() && !plansBlind();
  return weather_.isKnown() && !is_known_to_plans ? weather_.mean() : vessel::Disturbance{};
}

bool Safety::liesOnAnyHeading() const {
  return vessel::InverseDynamics(vessel_, leansInto()).greatestLoadAbeam() <=
         vessel::kRestMps * vessel_.manoeuvring.sway_drag_kgps;
}

vessel::Disturbance Safety::lightLoad() const {
  return liesOnAnyHeading() ? leansInto() : vessel::Disturbance{};
}

bool Safety::mayCreep() const {
  return !plansWithWeather() && liesOnAnyHeading();
}

vessel::Disturbance Safety::planDisturbance() const {
  return plansWithWeather() && !plansBlind() ? weather_.mean() : vessel::Disturbance{};
}

double Safety::freeThrustShare() const {
  // Little of it is what every plan leaves; more than the most would only make the vessel crab
  // more, for it is the tracker that finds the thrust.
  constexpr double kLittle = 0.05;
  constexpr double kMostForMean = 0.1;
  const bool found = plansWithWeather() && !plansBlind();  // by the plan itself
  const double mean = found ? 0.0 : std::clamp(weather_.meanShare() - kLittle, 0.0, kMostForMean);
  return planThrustShare(options_.thrust_share, std::max(weather_.gustShare() + mean, waveShare()),
                         times_left_behind_);
}

double Safety::waveShare() const {
  // With less than most of the thrust the hull runs before the wind so slowly that it is carried.
  // Where the water is wide a wave may take the heading for a moment.
  constexpr double kMost = 0.3;
  constexpr double kMostInWideWater = 0.25;
  return std::min(levels_.level() == 0 ? kMostInWideWater : kMost, weather_.waveShare());
}

double Safety::speedInWaves() const {
  const double share = planThrustShare(options_.thrust_share, waveShare(), 0);
  return feasibility::SafetyLimits::of(vessel_, 0.0, share).speed_max_mps;
}

double Safety::nextThrustShare() const {
  return std::min(options_.thrust_share, freeThrustShare() + timesRefused() * kMoreThrust);
}

int Safety::timesRefused() const {
  return times_refused_ - (plansBlind() ? kRefusedMost : 0);
}

bool Safety::plansBlind() const {
  return plansWithWeather() && times_refused_ >= kRefusedMost;
}

double Safety::slowShare() const {
  constexpr double kLeast = 0.5;  // slower still, the hull hardly answers
  if (plansWithWeather()) {
    return 1.0;  // slower, it would be carried by what pushes, and hold no heading
  }
  const double usual_mps = feasibility::SafetyLimits::of(vessel_, 0.0).speed_max_mps;
  return std::max({kLeast, std::pow(0.5, times_refused_), std::min(1.0, leastPace() / usual_mps)});
}

double Safety::restHeading(double psi_rad) const {
  const vessel::ManoeuvringModel& model = vessel_.manoeuvring;
  return !plansWithWeather() && vessel::canLie(model, weather_.mean(), psi_rad)
             ? psi_rad
             : wrapAngle(vessel::headingIntoLoad(model, weather_.mean(), psi_rad));
}

double Safety::turnIntoLoad(double psi_rad) const {
  return plansWithWeather() ? wrapAngle(restHeading(psi_rad) - psi_rad) : 0.0;
}

bool Safety::isHeldInWind(double psi_rad) const {
  constexpr double kHeldRad = 0.6;
  const double bow = vessel::headingIntoLoad(vessel_.manoeuvring, weather_.mean(), psi_rad);
  return std::abs(std::sin(psi_rad - bow)) < std::sin(kHeldRad);
}

// Bow to it, the gusts' force must not exceed the thrust; and on the way from one heading to
// another the mean wind's moment must leave some to turn with.
std::string Safety::beyondThrust() const {
  if (!weather_.isKnown()) {
    return {};
  }
  constexpr double kAtMost = 0.95;  // of the thrust
  const vessel::ManoeuvringModel& model = vessel_.manoeuvring;
  const vessel::Thrusters& t = vessel_.thrusters;
  const vessel::Disturbance gust = weather_.gust();
  const double push_n = vessel::surgeAtRest(model, gust, vessel::headingIntoLoad(model, gust, 0.0));
  if (push_n > kAtMost * 2.0 * t.ahead_max_n) {
    return text("wind and current push with %.0f N in gusts, the thrusters with %.0f N", push_n,
                2.0 * t.ahead_max_n);
  }
  const double moment_nm = vessel::greatestMoment(t);
  const double turning_nm = weather_.greatestMoment();
  if (turning_nm > kAtMost * moment_nm) {
    return text("the wind turns the hull with %.0f N m, the thrusters with %.0f N m", turning_nm,
                moment_nm);
  }
  return {};
}

void Safety::feel(double now_s, const vessel::Disturbance& estimate) {
  constexpr double kForgetsS = 120.0;  // what a gust took, one time after the other
  weather_.feel(now_s, estimate);
  if (times_left_behind_ > 0 && now_s - left_behind_s_ > kForgetsS) {
    --times_left_behind_;
    left_behind_s_ = now_s;
  }
}

void Safety::leftBehind(double now_s) {
  ++times_left_behind_;
  left_behind_s_ = now_s;
}

void Safety::newGoal() {
  times_left_behind_ = 0;
  planTaken();
}

bool Safety::refused() {
  // On the narrower levels a hull in a firm load is set aside by more than they leave beside it: a
  // wide way planned for still water, and left again when it is set aside, comes first. Before it
  // comes one that takes what is left over for the waves.
  if (plansWithWeather() && !plansBlind() && levels_.level() + 1 >= kLevelsInLoad) {
    const bool has_more = times_refused_ == 0 && nextThrustShare() < options_.thrust_share - 0.01;
    times_refused_ = has_more ? 1 : kRefusedMost;
    levels_.widest();
    return true;
  }
  const bool more = levels_.narrower(weather_.isKnown() && weather_.isStrong());
  if (!more) {
    ++times_refused_;
  }
  return more;
}

void Safety::comeToRest() {
  // In a firm load the plans that need most are made blind, and were tried before.
  if (!plansWithWeather()) {
    times_refused_ = 0;
  }
  levels_.widest();
}

void Safety::planTaken() {
  times_refused_ = 0;
  levels_.widest();
}

}  // namespace otter_nav::mission
