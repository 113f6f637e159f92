#include "otter_nav/mission/supervisor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "arrival.hpp"
#include "better_plans.hpp"
#include "driven.hpp"
#include "following.hpp"
#include "goal_check.hpp"
#include "moment.hpp"
#include "others.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/text.hpp"
#include "otter_nav/stopping/back_off.hpp"
#include "otter_nav/stopping/braking.hpp"
#include "otter_nav/stopping/splice.hpp"
#include "otter_nav/stopping/stand_aside.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "plan_requests.hpp"
#include "retry_budget.hpp"
#include "sailed.hpp"
#include "sea_room.hpp"
#include "stops.hpp"
#include "way_ahead.hpp"

namespace otter_nav::mission {
namespace {

using feasibility::Obstacles;
using trajectory::TimedTrajectory;
using trajectory::Trajectory;

std::string conflictText(const stopping::Conflict& conflict) {
  return text("only %.2f m clear at (%.1f m, %.1f m) on the way", conflict.clearance_m,
              conflict.position.x(), conflict.position.y());
}

constexpr unsigned in(Phase phase) {
  return 1U << static_cast<unsigned>(phase);
}
constexpr unsigned kAny = ~0U;
constexpr unsigned kSailing = in(Phase::kSailing);
constexpr unsigned kReplanning = in(Phase::kReplanning);
constexpr unsigned kUnderWay = kSailing | kReplanning;
constexpr unsigned kWaiting = in(Phase::kPlanning) | in(Phase::kStopped);
constexpr unsigned kManoeuvring = in(Phase::kBackingOff) | in(Phase::kTurningBack);
constexpr unsigned kComingToRest = in(Phase::kStopping) | kManoeuvring;
constexpr unsigned kEvading = in(Phase::kEvading);

// Why a plan is given up, or the vessel stops: something in the way, or the weather's doing, by
// which the vessel is off its way, wants for thrust on it, or can't hold the goal's heading.
enum class Cause { kOther, kClearance, kOff, kLoad, kGoalHeading };

template <typename Decider>
struct RuleOf {
  unsigned phases;
  bool (Decider::*when)(const Moment&);
  Orders (Decider::*then)(const Moment&);
  bool goes_on = false;
};

constexpr const char* kBlind = "no scan comes into the map any more";

class Decider final : public Supervisor {
 public:
  Decider(const SupervisorOptions& options, const vessel::Parameters& vessel, std::uint64_t seed)
      : options_(options),
        vessel_(vessel),
        plans_(options, vessel, seed),
        stops_(plans_.safety, vessel_),
        retries_(options.rounds_from_rest, options.stops_max),
        following_(options_, plans_.safety, vessel_),
        driven_(plans_.safety, vessel_),
        better_(options_, plans_, vessel_),
        others_(options_, plans_.safety, vessel_) {}

  Result<Orders> setGoal(double now_s, const vessel::Pose& goal, const Situation& situation,
                         const Obstacles& obstacles) override {
    const Moment m = others_.see(now_s, situation, obstacles);
    if (const Status status = checkGoal(goal, m.obstacles, safety().narrowest()); !status) {
      return failure(status.error().message);
    }
    goal_ = goal;
    sailed_.plan.goal_psi_rad = goal.psi_rad;
    calm_by_s_.reset();
    plans_.forgetDeadEnds();
    sailed_since_s_ = m.now_s;
    safety().newGoal();
    feel(m);
    plans_.drop();
    plans_.latency.onTime();
    retries_.newGoal(m.now_s);
    calmer_by_s_ = m.now_s;
    rooms_made_ = 0;
    cancelled_ = false;
    suspended_.reset();
    replans_ = {};
    cause_ = Cause::kOther;
    learns_gusts_ = false;
    far_round_ = FarRound::kNotMet;
    nearest_left_m_ = std::numeric_limits<double>::infinity();
    others_.newGoal(m.now_s);
    return handedOut(m, follow(kGoalRules, m));
  }

  Orders cancel(double now_s, const Situation& situation, const Obstacles& obstacles,
                std::string why) override {
    const Moment m = others_.see(now_s, situation, obstacles);
    plans_.drop();
    suspended_.reset();
    end_reason_ = std::move(why);
    return handedOut(m, follow(kCancelRules, m));
  }

  Result<Orders> pause(double now_s, const Situation& situation,
                       const Obstacles& obstacles) override {
    if (!hasMission()) {
      return failure("there is no mission to pause");
    }
    return suspend(others_.see(now_s, situation, obstacles), Phase::kPaused);
  }
  Orders hold(double now_s, const Situation& situation, const Obstacles& obstacles) override {
    return suspend(others_.see(now_s, situation, obstacles), Phase::kHolding);
  }
  Result<Orders> resume(double now_s, const Situation& situation,
                        const Obstacles& obstacles) override {
    const Moment m = others_.see(now_s, situation, obstacles);
    if (!std::exchange(suspended_, std::nullopt)) {
      return failure("nothing is paused");
    }
    safety().tryWidest();
    return handedOut(m, follow(kResumeRules, m));
  }

  void setOptions(const SupervisorOptions& options) override {
    options_ = options;
    safety().setOptions(options);
  }

  Status setSpeedMax(double speed_mps) override {
    if (Status status = checkSpeedMax(speed_mps); !status) {
      return status;
    }
    safety().setSpeedMax(speed_mps);
    return {};
  }

  Orders update(double now_s, const Situation& situation, const Obstacles& obstacles) override {
    const Moment m = others_.see(now_s, situation, obstacles);
    feel(m);
    lookOut(m);
    return handedOut(m, plans_.overdue(now_s)
                            ? planFailed(m, "no answer from the planner", plans_.take())
                            : follow(kRules, m));
  }

  Orders planFinished(double now_s, int id, const planner::Plan& plan, const Situation& situation,
                      const Obstacles& obstacles) override {
    const Moment m = others_.see(now_s, situation, obstacles);
    std::optional<PlanRequests::Asked> asked = plans_.take(id);
    if (!asked) {
      return {};
    }
    asked->left_m = plan.left_m;
    if (plan.outcome != planner::Outcome::kSolved || plan.trajectory.empty()) {
      return handedOut(m, planFailed(m, plan.reason, *asked));
    }
    return handedOut(m, asked->from == From::kRest ? takeFromRest(m, plan, *asked)
                                                   : takeMoving(m, plan, *asked));
  }

  [[nodiscard]] double speedMax() const override { return plans_.safety.speedMax(); }
  [[nodiscard]] Phase phase() const override { return phase_; }
  [[nodiscard]] const std::string& reason() const override { return reason_; }
  [[nodiscard]] const vessel::Pose& goal() const override { return goal_; }
  [[nodiscard]] const TimedTrajectory& sailed() const override { return sailed_.path; }
  [[nodiscard]] const std::optional<TimedTrajectory>& lastStop() const override {
    return stops_.kept();
  }
  [[nodiscard]] double plannedClearance() const override { return sailed_.plan.clearance_m; }
  [[nodiscard]] std::vector<encounter::Encounter> encounters() const override {
    return others_.encounters();
  }
  [[nodiscard]] Replans replans() const override { return replans_; }
  [[nodiscard]] int stops() const override { return retries_.stops(); }

 private:
  Orders handedOut(const Moment& m, Orders orders) {
    if (orders.plan && others_.future()) {
      orders.plan->others = *others_.future();
    }
    if (orders.sail || orders.stop) {
      sailed_.given_s = m.now_s;
    }
    return orders;
  }

  // ---- The rules' conditions

  bool always(const Moment& /*m*/) { return true; }
  bool moves(const Moment& m) {
    constexpr double kMovingMps = 0.3;
    return vessel::speedOf(m.situation.state) > kMovingMps;
  }
  bool hasFault(const Moment& m) { return !faultOf(m).empty(); }
  // What comes into the way would not be seen. A vessel whose map never had a scan sails by the
  // chart.
  bool isBlind(const Moment& m) {
    constexpr double kPatienceS = 2.0;
    const std::optional<double>& scanned_s = m.situation.scanned_s;
    return scanned_s && m.now_s - *scanned_s > kPatienceS;
  }
  bool isCancelled(const Moment& /*m*/) { return cancelled_; }
  bool isSuspended(const Moment& /*m*/) { return suspended_.has_value(); }
  bool hasNoMission(const Moment& /*m*/) { return !hasMission(); }
  bool mustWait(const Moment& m) { return plans_.waits() || retries_.pauses(m.now_s); }
  // The tracker has just begun to estimate it.
  bool doesNotKnowTheWeather(const Moment& /*m*/) {
    return !weather().isKnown() || (safety().mayPlanWithWeather() && weather().rises());
  }
  // It steers into waves that it doesn't know yet, and swings its corners by as much again as they
  // set it aside.
  bool learnsTheWaves(const Moment& m) { return waves_since_s_ && mayLearnTheWaves(m); }
  // The plan that was found has less than the widest room, and what gusts do is a guess yet.
  bool learnsTheGusts(const Moment& /*m*/) { return learns_gusts_ && weather().mayTurnOutStrong(); }

  // Or so near the edge that no plan starts there: it counts as occupied.
  bool isOverTheEdge(const Moment& m) { return knowsPlace(m) && inside(m) < safety().narrowest(); }
  // With its trajectory out of reach; as long as it follows that, it comes back by itself.
  bool isLostOverTheEdge(const Moment& m) { return isFarOff(m) && inside(m) < 0.0; }

  bool isAtTheEnd(const Moment& m) { return sailed_.isAtTheEnd(m.now_s); }
  bool isThere(const Moment& m) { return arrival(m).isThere(); }
  bool hasArrived(const Moment& m) { return arrival(m).hasArrived(); }
  bool settlesNoMore(const Moment& m) { return arrival(m).settlesNoMore(); }

  bool isNarrow(const Moment& m) {
    conflict_ = wayAhead(m).narrow();
    return conflict_.found;
  }
  bool isAboutToTouch(const Moment& m) { return wayAhead(m).isAboutToTouch(); }
  bool isClearAgain(const Moment& m) { return cause_ == Cause::kClearance && !isNarrow(m); }
  // Of what is sailed; if there is one it is kept until the next is found.
  bool hasNoStop(const Moment& m) {
    return !stops_.find(m, sailed_.path, sailed_.plan.limits, sailed_.off(m, vessel_));
  }
  // The hull does not pass on its way, no plan leads round that, and of the stops before it none
  // that begins later ends with as much beside the hull as the one that is kept: to go on only
  // leads into the narrow place.
  bool endsNarrowerLater(const Moment& m) {
    if (cause_ != Cause::kClearance || !stops_.kept() || mayPlanRoundIt(m)) {
      return false;
    }
    const stopping::Conflict hull = wayAhead(m).tooNear();
    return hull.found &&
           stops_.endNarrowerThanKept(m, sailed_.path, sailed_.plan.limits, hull.time_s);
  }
  // From what is sailed, before that is not clear; until there was none at any clearance.
  bool mayPlanRoundIt(const Moment& m) {
    return safety().timesRefused() == 0 &&
           plans_.beginning(m.now_s, sailed_.path, sailed_.path.start_time_s + conflict_.time_s);
  }
  // The way to rest itself is not clear any more, or its end, and there is a milder one.
  bool hasMilderStop(const Moment& m) {
    constexpr double kAgainS = 0.2;
    if (sailed_.path.left(m.now_s) <= 0.0 || m.now_s - stops_looked_for_s_ < kAgainS) {
      return false;
    }
    const stopping::Off off = sailed_.off(m, vessel_);
    const stopping::Touch now = stopping::firstTouch(
        sailed_.path.trajectory, sailed_.path.elapsed(m.now_s), sailed_.obstacles(m), vessel_, off);
    if (std::isinf(now.after_s)) {
      return false;
    }
    stops_looked_for_s_ = m.now_s;
    other_stop_ =
        stops_.now(m, sailed_.path, sailed_.plan.limits, sailed_.off(m, vessel_)).trajectory;
    return stopping::firstTouch(other_stop_, 0.0, m.obstacles.startingAt(m.now_s), vessel_, off)
        .milderThan(now);
  }
  // From a way to rest a plan may lead on.
  bool mayGoOn(const Moment& m) {
    return !cancelled_ && !suspended_ && !mustWait(m) && !hasFault(m) && !isBlind(m) &&
           !isFarOff(m) && sailed_.path.left(m.now_s) > 0.0;
  }
  // Other vessels ask for another way than the one being sailed.
  bool shouldMakeWay(const Moment& m) {
    if (m.situation.tracks.empty()) {
      return false;
    }
    if (const std::optional<double> joint = plans_.joint(m.now_s, sailed_.path)) {
      way_made_ = others_.makeWay(m, sailed_, goal_.position, *joint,
                                  PlanRequests::joiningSpeed(sailed_.path));
      return way_made_.has_value();
    }
    return false;
  }
  bool isFarOff(const Moment& m) { return following_.isFarOff(m, sailed_); }
  double listedClearance(std::size_t level) const {
    const std::vector<double>& levels = options_.side_clearances_m;
    return centreClearance(vessel_.hull, levels[std::min(level, levels.size() - 1)]);
  }
  bool fallsBehind(const Moment& m) {
    later_ = following_.fallsBehind(m, sailed_);
    return later_ && stops_.find(m, later_->path, sailed_.plan.limits, stopping::Off{});
  }
  bool isLeftBehind(const Moment& m) { return following_.isLeftBehind(m, sailed_); }
  bool hasLostItsHeading(const Moment& m) { return following_.hasLostItsHeading(m, sailed_); }
  bool isSetAside(const Moment& m) { return following_.isSetAside(m, sailed_); }
  // It had to stop hereabouts before: in such a wind it waits longer each time, for less of it.
  bool waitsForLessWind(const Moment& m) { return weather().isStrong() && m.now_s < calmer_by_s_; }
  static constexpr int kRoomsMost = 3;  // made before another plan is sailed; more lead nowhere
  bool liesOffALeeShore(const Moment& m) {
    return driven_.liesOffALeeShore(m, retries_.stops(), rooms_made_ < kRoomsMost);
  }
  // So in strong wind, whether it lies still or not: holding the place against a gust takes the
  // moment that holds the heading, and to windward there is a way out.
  bool isDrivenAshore(const Moment& m) { return weather().isStrong() && liesOffALeeShore(m); }
  // All but at rest, and another vessel comes over her; there is a way out.
  bool isRunDown(const Moment& m) {
    constexpr double kSlowMps = 0.6;
    aside_.reset();
    const vessel::State& x = m.situation.state;
    const Obstacles now = m.obstacles.startingAt(m.now_s);
    if (!m.situation.tracks.empty() && !hasFault(m) && vessel::speedOf(x) < kSlowMps &&
        stopping::isRunDown(x.head<2>(), now, vessel_.hull)) {
      aside_ = stopping::standAside(x, now, vessel_);
    }
    return aside_.has_value();
  }
  bool isDrivenOnto(const Moment& m) {
    const bool under_way = (in(phase_)&kUnderWay) != 0;
    const bool is_escaping = escapes_ && phase_ == Phase::kBackingOff;
    return knowsPlace(m) && driven_.isDrivenOntoSomething(m, sailed_,
                                                          under_way     ? Driven::Lies::kOnItsWay
                                                          : is_escaping ? Driven::Lies::kEscaping
                                                                        : Driven::Lies::kOffPlans);
  }
  bool mustEvade(const Moment& m) {
    const bool under_way = (in(phase_)&kUnderWay) != 0;
    // Where there was no way the rules for who rests, or comes to rest, are followed for a moment.
    const bool others_come_first = under_way ? !hasArrived(m) : !others_.leftNoWay(m.now_s);
    return others_.future() && hasMission() && !suspended_ && !hasFault(m) && others_come_first &&
           others_.crowd(m, sailed_);
  }
  bool hasRoomAgain(const Moment& m) { return !plans_.waits() && others_.areFew(m, sailed_); }
  bool hasRoomInVain(const Moment& m) { return others_.areFewInVain(m, sailed_); }
  // Plans from rest begin bow to a firm load. The tracker turns the resting hull there. Nor is one
  // begun from a heading lost in strong wind, bow and stern off it: the next gust would have it.
  bool liesAcrossTheLoad(const Moment& m) {
    constexpr double kPatienceS = 20.0;
    constexpr double kStillMps = 0.5;
    constexpr double kStillRadps = 0.25;
    const vessel::State& x = m.situation.state;
    const bool still =
        vessel::speedOf(x) < kStillMps && std::abs(x[vessel::kYawRate]) < kStillRadps;
    const bool lies = safety().plansWithWeather()
                          ? std::abs(safety().turnIntoLoad(x[vessel::kPsi])) < kIntoLoadRad
                          : safety().isHeldInWind(x[vessel::kPsi]);
    if ((still && lies) || !(safety().plansWithWeather() || weather().isStrong())) {
      across_since_s_.reset();
      return false;
    }
    if (!across_since_s_) {
      across_since_s_ = m.now_s;
    }
    return m.now_s - *across_since_s_ < kPatienceS;
  }
  bool lacksThrust(const Moment& m) { return better_.lacksThrust(m, sailed_, replansForLoad()); }
  bool isTooFastForGusts(const Moment& m) { return better_.isTooFastForGusts(m, sailed_); }
  bool isTooFastForWaves(const Moment& m) { return better_.isTooFastForWaves(m, sailed_); }
  bool passesNearInWideWater(const Moment& m) {
    return better_.passesNearInWideWater(m, sailed_, goal_.position);
  }
  bool passesNearInNarrowWater(const Moment& m) {
    return better_.passesNearInNarrowWater(m, sailed_);
  }
  bool passesTooNear(const Moment& m) { return better_.passesTooNear(m, sailed_); }
  bool endsOnAWrongHeading(const Moment& m) {
    return better_.endsOnAWrongHeading(m, sailed_, goal_.psi_rad) &&
           !arrival(m).staysOffGoalHeading();
  }
  bool isNeedlesslySlow(const Moment& m) { return better_.isNeedlesslySlow(m, sailed_); }
  bool goesFarRound(const Moment& m) { return better_.goesFarRound(m, sailed_, goal_.position); }
  bool mayImprove(const Moment& m) { return better_.mayImprove(m, sailed_); }
  bool isBeyondThrust(const Moment& /*m*/) {
    const bool is = !safety().beyondThrust().empty();
    if (!is) {
      calm_by_s_.reset();
    }
    return is;
  }
  bool hasNewSpeedMax(const Moment& /*m*/) {
    return sailed_.plan.speed_limit_mps != safety().speedMax();
  }
  // A plan that slows down is to be had in time, or there is none.
  bool isTooFastForLong(const Moment& m) {
    constexpr double kPatienceS = 4.0;
    if (!isTooFast()) {
      too_fast_since_s_ = m.now_s;
    }
    return m.now_s - too_fast_since_s_ > kPatienceS;
  }
  // What was free when it set off may not be any more: the water astern is the less known.
  bool isBlocked(const Moment& m) {
    const double at = sailed_.path.elapsed(m.now_s);
    const auto clear =
        phase_ == Phase::kBackingOff ? stopping::backOffIsClear : stopping::turnBackIsClear;
    // Halfway out of another's way is the worst place to stop, and an escape is found anew.
    const Obstacles obstacles = is_aside_ ? Obstacles(m.obstacles.field()) : sailed_.obstacles(m);
    return !escapes_ && at < sailed_.path.trajectory.duration() &&
           !clear(sailed_.path.trajectory, at, obstacles, vessel_);
  }
  bool isStillMoving(const Moment& m) {
    constexpr double kPatienceS = 15.0;
    const bool rests = knowsPlace(m) && atRest(m.situation.state);
    const bool waits = !rests && m.now_s - stop_time_s_ < kPatienceS;
    return sailed_.isEmpty() ? waits && !isDriven(m) : waits || !isAtTheEnd(m);
  }
  // While it stops by itself, with way off: it need not come to rest before it makes room.
  bool isDriven(const Moment& m) {
    constexpr double kSlowMps = 1.0;
    constexpr double kFirstS = 1.0;
    return phase_ == Phase::kStopping && hasMission() && !suspended_ &&
           m.now_s - stop_time_s_ >= kFirstS && knowsPlace(m) &&
           vessel::speedOf(m.situation.state) < kSlowMps && isDrivenAshore(m);
  }
  bool isLost(const Moment& m) { return !knowsPlace(m); }

  // ---- The rules' actions

  Orders keepOn(const Moment& /*m*/) { return {}; }

  Orders planFirst(const Moment& m) {
    enter(Phase::kPlanning);
    across_since_s_.reset();
    if (doesNotKnowTheWeather(m)) {
      return holdHere();  // without thrust it would be set aside and turned meanwhile
    }
    if (isOverTheEdge(m)) {
      return turnBack(m);
    }
    return liesAcrossTheLoad(m) ? turnIntoTheLoad(m) : planFromRest(m);
  }
  Orders planForNewGoal(const Moment& m) {
    replan("new goal");
    return planFromSailed(m);
  }
  Orders planFromRest(const Moment& m) {
    return {plans_.fromRest(m.now_s, whereItIsHeld(m), goal_, m.obstacles), {}, false};
  }
  // Near something what begins from rest begins where the hull is held, not where a swing has it:
  // else each way that is begun and broken off holds it a centimetre farther down the wind than the
  // one before, and at last onto what lies there.
  [[nodiscard]] vessel::State whereItIsHeld(const Moment& m) const {
    constexpr double kOffM = 0.1;
    constexpr double kOffRad = 0.1;
    vessel::State x = withoutSwing(m);
    if (sailed_.isEmpty() || !sailed_.isAtTheEnd(m.now_s) ||
        m.obstacles.clearance(x.head<2>(), m.now_s) > vessel_.hull.length_m) {
      return x;
    }
    const Trajectory& path = sailed_.path.trajectory;
    const vessel::State held = path.sample(path.duration(), vessel_).state;
    const vessel::State& now = m.situation.state;
    if ((now - held).head<2>().norm() < kOffM &&
        std::abs(wrapAngle(now[vessel::kPsi] - held[vessel::kPsi])) < kOffRad) {
      x.head<3>() = held.head<3>();
    }
    return x;
  }
  // Nothing if the vessel is about to come to rest: what comes then is for the rules at the
  // trajectory's end, or for the brake.
  Orders planFromSailed(const Moment& m) {
    constexpr double kForGustsShare = 0.7;  // of the room that they need, which is known roughly
    // What comes into the way before it rests is no reason to plan from there.
    const bool in_the_way = phase_ == Phase::kReplanning && conflict_.found;
    const double rests_by_s = in_the_way ? sailed_.path.start_time_s + conflict_.time_s
                                         : std::numeric_limits<double>::infinity();
    Orders orders{plans_.fromSailed(m.now_s, sailed_.path, sailed_.plan.thrust_share, goal_,
                                    m.obstacles, rests_by_s),
                  {},
                  false};
    if (!orders.plan) {
      safety().tryWidest();  // too fast for this level, perhaps for a while: the others first
    }
    if (orders.plan && phase_ == Phase::kReplanning && cause_ == Cause::kClearance) {
      const feasibility::SafetyLimits& asked = orders.plan->query.limits;
      const double listed_m = std::min(listedClearance(safety().level()), asked.clearance_m);
      const double enough_m = listed_m + kForGustsShare * (asked.clearance_m - listed_m);
      if (wayAhead(m).hasRoomFor(asked, enough_m)) {
        sailed_.plan.clearance_m = std::min(sailed_.plan.clearance_m, enough_m);
        return keepThePlan(m);
      }
    }
    return orders;
  }
  Orders makeWay(const Moment& m) {
    TimedTrajectory path = std::move(way_made_->path);
    if (!way_made_->to_the_goal) {
      Orders orders{plans_.onward(m.now_s, std::move(path), sailed_.plan.thrust_share,
                                  sailed_.plan.limits.speed_max_mps, goal_, m.obstacles),
                    {},
                    false};
      plans_.markAsWorthless(m.now_s + way_made_->worth_s);
      return orders;
    }
    plans_.drop();
    ++replans_.all;
    const double catch_up_mps = sailed_.path.speed_max_mps;
    sailed_.path = stopping::splice(sailed_.path, m.now_s, path);
    sailed_.path.speed_max_mps = catch_up_mps;
    enter(Phase::kSailing);
    return {std::nullopt, sailed_.path, false};
  }
  Orders planFromFarOff(const Moment& m) {
    if (phase_ == Phase::kSailing) {  // not for each attempt again
      safety().leftBehind(m.now_s);
    }
    following_.startAnew();
    return planFromVessel(m, "far off the trajectory", Cause::kOff);
  }
  Orders planForWeather(const Moment& m) {
    better_.asked(BetterPlans::For::kThrust, m.now_s);
    return planFromVessel(m, "wind and current take thrust that the plan counts on", Cause::kLoad);
  }
  Orders planForGoalHeading(const Moment& m) {
    replan("the heading at the goal is another in this wind and current", Cause::kGoalHeading);
    Orders orders = planFromSailed(m);
    if (!orders.plan) {
      return enter(Phase::kSailing);
    }
    return orders;
  }
  Orders planForGusts(const Moment& m) {
    better_.asked(BetterPlans::For::kGusts, m.now_s);
    replan(text("gusts take the moment that holds headings at %.1f m/s",
                sailed_.plan.limits.speed_max_mps),
           Cause::kLoad);
    Orders orders = planFromSailed(m);
    return orders.plan ? orders : enter(Phase::kSailing);
  }
  Orders planForSpeedMax(const Moment& m) {
    if (isTooFast()) {
      replan(text("the speed limit is %.2f m/s now", safety().speedMax()));
      return planFromSailed(m);
    }
    sailed_.plan.speed_limit_mps = safety().speedMax();
    Orders orders = planToImprove(m);
    // Nor when it is behind.
    feasibility::SafetyLimits catching_up;
    catching_up.speed_max_mps = sailed_.path.speed_max_mps;
    catching_up.limitSpeed(safety().speedMax());
    if (catching_up.speed_max_mps < sailed_.path.speed_max_mps) {
      sailed_.path.speed_max_mps = catching_up.speed_max_mps;
      orders.sail = sailed_.path;
    }
    return orders;
  }
  Orders planFaster(const Moment& m) {
    safety().tryLevel(sailed_.plan.level, sailed_.plan.steps_wider);
    return improve(m);
  }
  Orders planSlower(const Moment& m) {
    better_.asked(BetterPlans::For::kWaves, m.now_s);
    safety().tryLevel(sailed_.plan.level, sailed_.plan.steps_wider);
    return improve(m, Gain::kThrust);
  }
  Orders planWider(const Moment& m) {
    better_.asked(BetterPlans::For::kRoom, m.now_s);
    better_.chooseWiderLevel(sailed_);
    return improve(m, Gain::kRoom);
  }
  Orders planInWideWater(const Moment& m) {
    better_.asked(BetterPlans::For::kWideWater, m.now_s);
    safety().tryWidest();
    return improve(m, Gain::kClearance);
  }
  Orders planInNarrowWater(const Moment& m) {
    better_.asked(BetterPlans::For::kBeside, m.now_s);
    safety().tryLevel(sailed_.plan.level, sailed_.plan.steps_wider);
    return improve(m, Gain::kBeside);
  }
  // A stop first, and from there a plan as from rest, if that is sooner at the goal.
  Orders planByStopping(const Moment& m) {
    better_.asked(BetterPlans::For::kStop, m.now_s);
    const double soon = sailed_.path.elapsed(m.now_s + plans_.latency.seconds());
    stopping::Braking braking =
        stops_.from(m, sailed_.path, soon, safety().stop(sailed_.plan.limits));
    if (!braking.clear) {
      return {};
    }
    safety().tryLevel(sailed_.plan.level, sailed_.plan.steps_wider);
    Orders orders{
        plans_.onward(m.now_s, {std::move(braking.trajectory), sailed_.path.start_time_s + soon},
                      sailed_.plan.thrust_share, sailed_.plan.limits.speed_max_mps, goal_,
                      m.obstacles),
        {},
        false};
    safety().tryWidest();
    plans_.markAsImprovement(Gain::kTime);
    return orders;
  }
  Orders planToImprove(const Moment& m) {
    better_.chooseLevelToImprove(sailed_);
    return improve(m);
  }
  Orders improve(const Moment& m, Gain gain = Gain::kTime) {
    // More room is no reason for the weather to wait.
    if (gain != Gain::kRoom && gain != Gain::kClearance && gain != Gain::kBeside) {
      better_.planned(m.now_s);
    }
    Orders orders = planFromSailed(m);
    safety().tryWidest();
    if (orders.plan) {
      plans_.markAsImprovement(gain);
    }
    return orders;
  }
  Orders planAnew(const Moment& m) {
    constexpr double kNearerM = 1.0;
    plans_.drop();
    if (sailed_.plan.left_m > 0.0 && sailed_.plan.left_m < nearest_left_m_ - kNearerM) {
      nearest_left_m_ = sailed_.plan.left_m;  // as far as it was planned: no stop that counts
      retries_.madeGood(m.now_s);
      safety().tryWidest();
      return enter(Phase::kStopped,
                   text("%.0f m of the way are to be planned", sailed_.plan.left_m));
    }
    const std::string why =
        text("not settled at the trajectory's end: %.2f m and %.2f rad from the goal, at %.2f m/s",
             arrival(m).distance(), arrival(m).headingOff(), vessel::speedOf(m.situation.state));
    cause_ = Cause::kOff;
    return rest(m, why, why);
  }

  Orders arrive(const Moment& m) { return enter(Phase::kArrived, arrival(m).whyOffHeading()); }
  // The way that is sailed would lead on.
  Orders arriveEvading(const Moment& m) {
    Orders orders = stopByItself(m, {});
    arrive(m);
    return orders;
  }
  Orders lookForAnother(const Moment& /*m*/) {
    return replan(conflictText(conflict_), Cause::kClearance);
  }
  Orders keepThePlan(const Moment& /*m*/) {
    plans_.drop();
    safety().planTaken();
    return enter(Phase::kSailing);
  }

  Orders brakeAsItLies(const Moment& m) {
    return brakeFor(m, "off its attitude, and about to touch something", Cause::kOff);
  }
  Orders brakeBlind(const Moment& m) { return brakeFor(m, kBlind); }
  Orders stopBlind(const Moment& m) { return stopByItself(m, kBlind); }
  Orders waitToSee(const Moment& m) {
    return enter(retries_.roundLost(m.now_s) ? phase_ : Phase::kFailed, kBlind);
  }
  Orders brakeForSpeed(const Moment& m) {
    return brakeFor(m, text("no plan keeps to %.2f m/s from here", safety().speedMax()));
  }
  Orders takeLastStop(const Moment& m) {
    return takeLastStop(m,
                        phase_ == Phase::kReplanning && conflict_.found
                            ? conflictText(conflict_)
                            : "no later stop in water known to be free",
                        Cause::kClearance);
  }
  // The last one that was found; it may be under way already when this is decided late.
  Orders takeLastStop(const Moment& m, std::string why, Cause cause) {
    constexpr double kApartM = 0.2;
    const auto place = [&](const TimedTrajectory& path) {
      return path.trajectory.flat(path.elapsed(m.now_s)).position;
    };
    const std::optional<TimedTrajectory>& kept = stops_.kept();
    if (!kept || (place(*kept) - place(sailed_.path)).norm() > kApartM) {
      return brakeFor(m, std::move(why), cause);
    }
    plans_.drop();
    cause_ = cause;
    stop_time_s_ = m.now_s;
    sailed_.path = *kept;
    enter(Phase::kStopping, std::move(why));
    return {std::nullopt, sailed_.path, false};
  }
  Orders changeTheStop(const Moment& m) {
    plans_.drop();  // what is asked for begins on the other
    sailed_.path = {std::move(other_stop_), m.now_s};
    return {std::nullopt, sailed_.path, false};
  }
  Orders sailLater(const Moment& m) {
    following_.putOff(m.now_s, *later_);
    sailed_.path = later_->path;
    return {std::nullopt, sailed_.path, false};
  }
  Orders goOn(const Moment& m) { return planFromSailed(m); }
  Orders brakeCancelled(const Moment& m) {
    cancelled_ = true;
    return brakeFor(m, end_reason_);
  }
  Orders stopCancelled(const Moment& m) {
    cancelled_ = true;
    return stopByItself(m, end_reason_);
  }
  Orders endAtRest(const Moment& /*m*/) {
    cancelled_ = true;
    return enter(phase_, end_reason_);
  }
  Orders stopForFault(const Moment& m) { return stopByItself(m, faultOf(m)); }
  Orders stopUnplanned(const Moment& m) { return stopByItself(m, "under way without a plan"); }
  // The tracker turns the bow into it and keeps the place; a plan from rest comes next.
  Orders stopHeadingLost(const Moment& m) {
    return stopByItself(
        m, text("heading lost in a gust, %.1f m off the trajectory", m.situation.tracking_error_m),
        Cause::kOff);
  }
  Orders turnIntoTheLoad(const Moment& /*m*/) { return holdHere(); }
  Orders keepThePlace(const Moment& /*m*/) {
    enter(phase_,
          text("waits for less wind, having stopped %d times hereabouts", retries_.stops()));
    return holdHere();
  }
  Orders makeSeaRoom(const Moment& m) {
    const double room_m = driven_.roomToMake();
    Orders orders = manoeuvre(
        m, Phase::kBackingOff, driven_.legToMakeIt(m),
        text("makes room, %.1f m %s", std::abs(room_m), room_m > 0.0 ? "ahead" : "astern"),
        Cause::kOff);
    makes_room_ = true;
    return orders;
  }
  Orders escape(const Moment& m) {
    (void)manoeuvre(m, Phase::kBackingOff, driven_.takeEscape(m.now_s),
                    "out of what wind and current drive it onto", Cause::kOff);
    escapes_ = true;
    sailed_.path.rolled_out = true;
    return {std::nullopt, sailed_.path, false};
  }
  Orders standAside(const Moment& m) {
    Orders orders =
        manoeuvre(m, Phase::kBackingOff, std::move(*aside_), "out of another vessel's way");
    is_aside_ = true;
    return orders;
  }
  Orders evade(const Moment& m) {
    const bool evades = phase_ == Phase::kEvading;
    const bool under_way = (in(phase_)&kUnderWay) != 0;
    const std::optional<Others::Evading> found =
        others_.evade(m, sailed_, goal_, evades, plans_.waits());
    if (!found) {
      return {};
    }
    const TimedTrajectory& path = found->way.path;
    if (path.trajectory.empty()) {
      return under_way ? takeLastStop(m, "no way among other vessels", Cause::kOther) : Orders{};
    }
    plans_.drop();  // what is asked for begins on what was sailed
    if (!evades) {
      stop_time_s_ = m.now_s;
      is_aside_ = makes_room_ = escapes_ = holds_ = false;
      cause_ = Cause::kOther;
      sailed_.plan.clearance_m = 0.0;
      others_.beginEvading(m.now_s);
    }
    enter(Phase::kEvading, text("among %zu other vessels, the nearest %.1f m beside the way",
                                m.situation.tracks.size(), found->way.danger.gap_m));
    sailed_.path = found->from_sailed ? stopping::splice(sailed_.path, m.now_s, path) : path;
    sailed_.path.speed_max_mps = found->speed_max_mps;
    return {std::nullopt, sailed_.path, false};
  }
  Orders planAfterEvading(const Moment& m) {
    Orders orders = planFromSailed(m);
    return orders.plan ? orders : evade(m);
  }
  // At rest there are plans that a moving vessel has no time for.
  Orders stopAfterEvading(const Moment& m) {
    Orders orders = brakeFor(m, "no plan leads on from out of other vessels' way");
    is_aside_ = true;
    return orders;
  }
  Orders stopSetAside(const Moment& m) {
    return stopByItself(
        m, text("set aside, %.1f m off the trajectory", m.situation.tracking_error_m), Cause::kOff);
  }
  Orders stopBeyondThrust(const Moment& m) {
    return stopByItself(m, "too much wind and current: " + safety().beyondThrust(), Cause::kOff);
  }
  // Bow to it, until it abates or for too long.
  Orders waitForCalm(const Moment& m) {
    constexpr double kPatienceS = 60.0;
    retries_.pause(m.now_s);
    if (!calm_by_s_) {
      calm_by_s_ = m.now_s + kPatienceS;
    } else if (m.now_s > *calm_by_s_) {
      return enter(Phase::kFailed, "too much wind and current: " + safety().beyondThrust());
    }
    enter(phase_, "waits for less wind and current: " + safety().beyondThrust());
    return holdHere();
  }
  Orders stopOverTheEdge(const Moment& m) {
    return stopByItself(m, "over the map's edge and far off the trajectory", Cause::kOff);
  }
  Orders stopBlocked(const Moment& m) {
    return stopByItself(m, std::string("something came up in the way while ") + name(phase_));
  }

  Orders brakeSuspended(const Moment& m) { return brakeFor(m, name(*suspended_)); }
  Orders stopSuspended(const Moment& m) { return stopByItself(m, name(*suspended_)); }
  // The tracker keeps the place at which the vessel rests.
  Orders restSuspended(const Moment& m) { return manoeuvre(m, *suspended_, {}, ""); }

  Orders idle(const Moment& /*m*/) { return enter(Phase::kIdle, end_reason_); }
  Orders idleAfterStop(const Moment& /*m*/) {
    cancelled_ = false;
    return enter(Phase::kIdle, reason_);
  }
  Orders giveUp(const Moment& /*m*/) { return enter(Phase::kFailed, reason_); }
  Orders loseRound(const Moment& m) {
    return retries_.roundLost(m.now_s) ? Orders{} : enter(Phase::kFailed, faultOf(m));
  }
  Orders restBeforeTheGoal(const Moment& m) {
    const bool backed_off = phase_ == Phase::kBackingOff && !is_aside_ && !makes_room_ && !escapes_;
    // No stop that counts: the one before it did.
    if (is_aside_ || ((makes_room_ || backed_off) && ++rooms_made_ <= kRoomsMost)) {
      safety().tryWidest();
      if (backed_off) {
        safety().comeToRest();
        retries_.madeGood(m.now_s);
      }
      return enter(Phase::kStopped, reason_);
    }
    return rest(m, reason_, text("stopped %d times, the last: ", retries_.stops() + 1) + reason_);
  }
  // Outside the map there are no plans to be had: without a free place on this side of the edge
  // the vessel holds, until wind or current bring it back or the map changes.
  Orders turnBack(const Moment& m) {
    if (std::optional<Trajectory> path =
            stopping::turnBack(m.situation.state, m.obstacles.startingAt(m.now_s), vessel_)) {
      return manoeuvre(m, Phase::kTurningBack, std::move(*path), "over the map's edge",
                       Cause::kOff);
    }
    if (inside(m) >= 0.0) {
      return planFromRest(m);
    }
    retries_.pause(m.now_s);
    return enter(phase_, "over the map's edge, and no free place to turn back to: holding");
  }

  // ---- The rules: the first whose phase and condition hold is followed; a rule that goes on lets
  // those below it act too.

  using Rule = RuleOf<Decider>;
  static constexpr bool kGoesOn = true;

  // A goal was accepted.
  static constexpr Rule kGoalRules[] = {
      {kUnderWay, &Decider::always, &Decider::planForNewGoal},
      {kComingToRest | kEvading, &Decider::always, &Decider::keepOn},
      {kAny, &Decider::moves, &Decider::stopUnplanned},
      {kAny, &Decider::always, &Decider::planFirst},
  };
  // The mission is given up.
  static constexpr Rule kCancelRules[] = {
      {kUnderWay, &Decider::always, &Decider::brakeCancelled},
      {kEvading, &Decider::always, &Decider::stopCancelled},
      {kComingToRest, &Decider::always, &Decider::endAtRest},
      {kAny, &Decider::moves, &Decider::stopCancelled},
      {kAny, &Decider::always, &Decider::idle},
  };
  // The vessel is to rest for a while.
  static constexpr Rule kSuspendRules[] = {
      {kUnderWay, &Decider::always, &Decider::brakeSuspended},
      {kEvading, &Decider::always, &Decider::stopSuspended},
      {kComingToRest, &Decider::always, &Decider::keepOn},
      {kAny, &Decider::moves, &Decider::stopSuspended},
      {kAny, &Decider::always, &Decider::restSuspended},
  };
  // And goes on.
  static constexpr Rule kResumeRules[] = {
      {kComingToRest, &Decider::always, &Decider::keepOn},
      {kAny, &Decider::hasNoMission, &Decider::idleAfterStop},
      {kAny, &Decider::always, &Decider::planFirst},
  };
  // Several times a second.
  static constexpr Rule kRules[] = {
      {kEvading, &Decider::hasFault, &Decider::stopForFault},
      {kEvading, &Decider::isBlind, &Decider::stopBlind},
      {kEvading, &Decider::isThere, &Decider::arriveEvading},
      {kEvading, &Decider::hasRoomInVain, &Decider::stopAfterEvading},
      {kEvading, &Decider::hasRoomAgain, &Decider::planAfterEvading},
      {kEvading, &Decider::always, &Decider::evade},

      {kUnderWay | kWaiting | in(Phase::kStopping) | in(Phase::kBackingOff), &Decider::mustEvade,
       &Decider::evade},
      {kUnderWay | kWaiting | kComingToRest, &Decider::isDrivenOnto, &Decider::escape},
      {kWaiting | in(Phase::kStopping), &Decider::isRunDown, &Decider::standAside},
      {kWaiting, &Decider::mustWait, &Decider::keepOn},
      {kWaiting, &Decider::hasFault, &Decider::loseRound},
      {kWaiting, &Decider::isBlind, &Decider::waitToSee},
      {kWaiting, &Decider::doesNotKnowTheWeather, &Decider::keepOn},
      {kWaiting, &Decider::learnsTheWaves, &Decider::keepOn},
      {kWaiting, &Decider::isOverTheEdge, &Decider::turnBack},
      {kWaiting, &Decider::isBeyondThrust, &Decider::waitForCalm},
      {kWaiting, &Decider::isDrivenAshore, &Decider::makeSeaRoom},
      {kWaiting, &Decider::liesAcrossTheLoad, &Decider::turnIntoTheLoad},
      {kWaiting, &Decider::liesOffALeeShore, &Decider::makeSeaRoom},
      {kWaiting, &Decider::learnsTheGusts, &Decider::keepOn},
      {kWaiting, &Decider::waitsForLessWind, &Decider::keepThePlace},
      {kWaiting, &Decider::always, &Decider::planFromRest},

      {kUnderWay, &Decider::hasFault, &Decider::stopForFault},
      {kUnderWay, &Decider::hasArrived, &Decider::arrive},
      {kUnderWay, &Decider::isBlind, &Decider::brakeBlind},
      {kUnderWay, &Decider::settlesNoMore, &Decider::planAnew},
      {kUnderWay, &Decider::isAtTheEnd, &Decider::keepOn},
      {kUnderWay, &Decider::isLostOverTheEdge, &Decider::stopOverTheEdge},
      {kUnderWay, &Decider::hasLostItsHeading, &Decider::stopHeadingLost},
      {kUnderWay, &Decider::isBeyondThrust, &Decider::stopBeyondThrust},
      {kUnderWay, &Decider::isSetAside, &Decider::stopSetAside},
      {kUnderWay, &Decider::isAboutToTouch, &Decider::brakeAsItLies},
      {kSailing, &Decider::isNarrow, &Decider::lookForAnother, kGoesOn},
      {kUnderWay, &Decider::hasNoStop, &Decider::takeLastStop},
      {kUnderWay, &Decider::isTooFastForLong, &Decider::brakeForSpeed},
      {kReplanning, &Decider::isClearAgain, &Decider::keepThePlan, kGoesOn},
      {kReplanning, &Decider::endsNarrowerLater, &Decider::takeLastStop},
      {kUnderWay, &Decider::mustWait, &Decider::keepOn},
      {kUnderWay, &Decider::shouldMakeWay, &Decider::makeWay},
      {kUnderWay, &Decider::isLeftBehind, &Decider::planFromFarOff},
      {kUnderWay, &Decider::fallsBehind, &Decider::sailLater},
      {kUnderWay, &Decider::lacksThrust, &Decider::planForWeather},
      {kSailing, &Decider::isTooFastForGusts, &Decider::planForGusts},
      {kUnderWay, &Decider::endsOnAWrongHeading, &Decider::planForGoalHeading},
      {kUnderWay, &Decider::hasNewSpeedMax, &Decider::planForSpeedMax},
      {kReplanning, &Decider::always, &Decider::planFromSailed},
      {kSailing, &Decider::isTooFastForWaves, &Decider::planSlower},
      {kSailing, &Decider::passesTooNear, &Decider::planWider},
      {kSailing, &Decider::passesNearInWideWater, &Decider::planInWideWater},
      {kSailing, &Decider::passesNearInNarrowWater, &Decider::planInNarrowWater},
      {kSailing, &Decider::isNeedlesslySlow, &Decider::planFaster},
      {kSailing, &Decider::goesFarRound, &Decider::planByStopping},
      {kSailing, &Decider::mayImprove, &Decider::planToImprove},

      {kManoeuvring, &Decider::hasFault, &Decider::stopForFault},
      {kManoeuvring, &Decider::isBlocked, &Decider::stopBlocked},
      {in(Phase::kStopping), &Decider::hasMilderStop, &Decider::changeTheStop},
      {in(Phase::kStopping), &Decider::mayGoOn, &Decider::goOn},
      {kComingToRest, &Decider::isStillMoving, &Decider::keepOn},
      {kComingToRest, &Decider::isSuspended, &Decider::restSuspended},
      {kComingToRest, &Decider::isCancelled, &Decider::idleAfterStop},
      {kComingToRest, &Decider::isLost, &Decider::giveUp},
      {kComingToRest, &Decider::always, &Decider::restBeforeTheGoal},
  };

  template <std::size_t Count>
  Orders follow(const Rule (&rules)[Count], const Moment& m) {
    for (const Rule& rule : rules) {
      if ((rule.phases & in(phase_)) != 0 && (this->*rule.when)(m)) {
        Orders orders = (this->*rule.then)(m);
        if (!rule.goes_on) {
          return orders;
        }
      }
    }
    return {};
  }

  // ---- What the rules are made of

  Safety& safety() { return plans_.safety; }
  const Weather& weather() { return safety().weather(); }
  void feel(const Moment& m) {
    if (m.situation.odometry_stamp_s > felt_s_) {  // not twice the same
      felt_s_ = m.situation.odometry_stamp_s;
      safety().feel(felt_s_, m.situation.disturbance.mean);
      const vessel::State& state = m.situation.state;
      double sway_mps = 0.0;
      if (!sailed_.isEmpty() && sailed_.path.elapsed(felt_s_) >= 0.0) {
        const vessel::State there =
            sailed_.path.trajectory
                .sample(sailed_.path.elapsed(felt_s_), vessel_, sailed_.plan.disturbance)
                .state;
        if (hasMission()) {  // else anybody may move it
          safety().wander(felt_s_, (state.head<2>() - there.head<2>()).norm());
        }
        sway_mps = there[vessel::kSway];
      }
      safety().feelSway(felt_s_, state[vessel::kSway] - sway_mps);
    }
  }
  // What is asked of one moment.
  [[nodiscard]] Arrival arrival(const Moment& m) {
    return {m, options_, safety(), vessel_, sailed_, goal_};
  }
  [[nodiscard]] WayAhead wayAhead(const Moment& m) { return {m, safety(), vessel_, sailed_}; }
  [[nodiscard]] SeaRoom seaRoom(const Moment& m) { return {m, safety(), vessel_.hull}; }
  // Without a trajectory the tracker does nothing: it shall keep the place, once.
  Orders holdHere() { return {std::nullopt, std::nullopt, !std::exchange(holds_, true)}; }

  bool hasMission() const {
    constexpr unsigned kNone = in(Phase::kIdle) | in(Phase::kArrived) | in(Phase::kFailed);
    return (in(phase_)&kNone) == 0 && !cancelled_;
  }
  // A vessel that had no mission has none afterwards either.
  Orders suspend(const Moment& m, Phase until) {
    cancelled_ = !hasMission();
    suspended_ = until;
    calm_by_s_.reset();
    plans_.drop();
    return handedOut(m, follow(kSuspendRules, m));
  }

  void lookOut(const Moment& m) {
    others_.observe(m);
    if (knowsPlace(m)) {
      others_.lookOut(m, sailed_, goal_.position);
    }
  }
  bool knowsPlace(const Moment& m) {
    return m.situation.state.allFinite() &&
           m.now_s - m.situation.odometry_stamp_s <= options_.odometry_timeout_s;
  }
  double inside(const Moment& m) {
    return stopping::insideMap(m.obstacles.field().geometry(), m.situation.state.head<2>());
  }
  std::string faultOf(const Moment& m) {
    if (m.situation.tracker_fault) {
      return "the tracker stops: " + m.situation.tracker_reason;
    }
    if (!m.situation.state.allFinite()) {
      return "odometry is not finite";
    }
    return knowsPlace(m) ? "" : "no odometry";
  }
  // The mission's limit fell below that of the plan.
  bool isTooFast() {
    feasibility::SafetyLimits limits = sailed_.plan.limits;
    limits.limitSpeed(safety().speedMax());
    return limits.speed_max_mps < sailed_.plan.limits.speed_max_mps;
  }
  Orders replan(std::string why, Cause cause = Cause::kOther) {
    cause_ = cause;
    return enter(Phase::kReplanning, std::move(why));
  }
  [[nodiscard]] bool replansForLoad() const {
    return phase_ == Phase::kReplanning && cause_ == Cause::kLoad;
  }
  // What was asked for to gain time was not for the weather's sake; what takes the place of a plan
  // that was given up, or follows a stop, was for that of its cause.
  void countReplan(const PlanRequests::Asked& asked) {
    if (asked.from == From::kRest && phase_ != Phase::kStopped) {
      return;
    }
    const bool for_weather = asked.gain ? *asked.gain == Gain::kThrust || *asked.gain == Gain::kRoom
                                        : cause_ != Cause::kOther && cause_ != Cause::kClearance;
    ++replans_.all;
    replans_.for_weather += for_weather ? 1 : 0;
  }
  Orders enter(Phase phase, std::string reason = {}) {
    phase_ = phase;
    reason_ = std::move(reason);
    if ((in(phase)&kUnderWay) == 0) {
      stops_.forget();
    }
    if (!hasMission()) {
      plans_.drop();  // there is nothing any more that it could be sailed for
    }
    return {};
  }
  // Only if a stop exists on it; else it is asked for again, or the vessel stops.
  Orders sail(const Moment& m, TimedTrajectory plan, const PlanRequests::Asked& asked) {
    const bool from_sailed = asked.from == From::kSailed;
    const feasibility::SafetyLimits& planned = asked.request.query.limits;
    const bool gives_up_a_stop = phase_ == Phase::kStopping && from_sailed;
    if (gives_up_a_stop && !wayAhead(m).hasRoomToJoin(plan, planned)) {
      return {};  // asked for again, from where it is less
    }
    // That on what was sailed is none on this one.
    std::optional<TimedTrajectory> last = stops_.kept();
    stops_.forget();
    if ((gives_up_a_stop && !stops_.existForAWhile(m, plan, planned)) ||
        !stops_.find(m, plan, planned, from_sailed ? sailed_.off(m, vessel_) : stopping::Off{})) {
      stops_.keep(std::move(last));
      return asked.gain ? Orders{} : planFailed(m, "no stop in water known to be free", asked);
    }
    countReplan(asked);
    sailed_.path = std::move(plan);
    sailed_.path.speed_max_mps = asked.catch_up_mps;
    sailed_.plan = plannedAs(m, asked);
    if (sailed_.plan.left_m == 0.0) {
      others_.rememberTheWay(sailed_.path.trajectory);
    }
    too_fast_since_s_ = m.now_s;
    better_.planned(m.now_s);
    sailed_since_s_ = m.now_s;
    holds_ = is_aside_ = makes_room_ = escapes_ = false;
    across_since_s_.reset();
    moves_since_s_.reset();
    conflict_ = {};
    rooms_made_ = 0;
    far_round_ = FarRound::kNotMet;
    safety().planTaken();
    enter(Phase::kSailing);
    return {std::nullopt, sailed_.path, false};
  }
  // What is sailed, as it was asked for.
  Planned plannedAs(const Moment& m, const PlanRequests::Asked& asked) {
    const planner::Query& query = asked.request.query;
    Planned planned;
    planned.left_m = asked.left_m;
    planned.is_last_resort =
        asked.slow || asked.left_m > 0.0 || stopping::restsBeforeItsEnd(sailed_.path.trajectory);
    planned.level = asked.level;
    planned.steps_wider = asked.steps_wider;
    planned.clearance_m = query.limits.clearance_m;
    planned.thrust_share = asked.request.thrust_share;
    planned.pace_share = asked.pace_share;
    planned.speed_limit_mps = asked.speed_max_mps;
    planned.limits = query.limits;
    planned.goal_psi_rad = query.goal.psi_rad;
    planned.disturbance = weather().mean();
    planned.overtaxed_s = overtaxed(m.now_s, sailed_.path, vessel_, planned.disturbance);
    planned.in_known_weather = weather().isKnown();
    planned.in_unknown_water = asked.in_unknown_water;
    planned.among_others = others_.areSome();
    return planned;
  }
  // A way to rest, without a plan; an empty one is the tracker's to find.
  Orders manoeuvre(const Moment& m, Phase phase, Trajectory path, std::string reason,
                   Cause cause = Cause::kOther) {
    plans_.drop();
    cause_ = cause;
    stop_time_s_ = m.now_s;
    is_aside_ = makes_room_ = escapes_ = false;
    sailed_.plan.clearance_m = 0.0;
    enter(phase, std::move(reason));
    if (path.empty()) {
      sailed_.path = {};
      holds_ = true;
      return {std::nullopt, std::nullopt, true};
    }
    sailed_.path = {std::move(path), m.now_s};
    return {std::nullopt, sailed_.path, false};
  }
  Orders stopByItself(const Moment& m, std::string reason, Cause cause = Cause::kOther) {
    return manoeuvre(m, Phase::kStopping, {}, std::move(reason), cause);
  }
  Orders brakeFor(const Moment& m, std::string reason, Cause cause = Cause::kOther) {
    return manoeuvre(
        m, Phase::kStopping,
        stops_.now(m, sailed_.path, sailed_.plan.limits, sailed_.off(m, vessel_)).trajectory,
        std::move(reason), cause);
  }
  // Plans from rest come next, unless there were too many stops.
  Orders rest(const Moment& m, const std::string& reason, const std::string& last) {
    constexpr double kCalmerS = 10.0;
    constexpr double kCalmerMostS = 60.0;
    // What befalls it while it waits for less wind is no other stop.
    if (!waitsForLessWind(m)) {
      const double left_m = (m.situation.state.head<2>() - goal_.position).norm();
      if (!retries_.stopped(m.now_s, left_m)) {
        return enter(Phase::kFailed, last);
      }
      if (weather().isStrong()) {
        calmer_by_s_ = m.now_s + std::min(kCalmerMostS, kCalmerS * (retries_.stops() - 1));
      }
    }
    safety().comeToRest();
    return enter(Phase::kStopped, reason);
  }

  Orders planFromVessel(const Moment& m, std::string why, Cause cause) {
    replan(std::move(why), cause);
    return askFromVessel(m);
  }
  Orders askFromVessel(const Moment& m) {
    return {plans_.fromVessel(m.now_s, withoutSwing(m), goal_, m.obstacles), {}, false};
  }
  Orders takeFromRest(const Moment& m, const planner::Plan& plan,
                      const PlanRequests::Asked& asked) {
    constexpr double kDriftM = 0.7;
    if (isBlind(m)) {
      return {};
    }
    const Eigen::Vector2d& start = asked.request.query.start.flat.position;
    if ((m.situation.state.head<2>() - start).norm() > kDriftM) {
      return retries_.roundLost(m.now_s)
                 ? Orders{}
                 : enter(Phase::kFailed, text("set aside by more than %.1f m while it plans, "
                                              "%d times",
                                              kDriftM, retries_.rounds()));
    }
    if ((isForNarrowWater(asked) || asked.in_unknown_water) && mayLearnTheWaves(m)) {
      waves_since_s_ = waves_since_s_.value_or(m.now_s);
      enter(phase_, "learns the waves before it goes through narrow or unknown water");
      return holdHere();
    }
    if (leadsFarRound(m, plan) && far_round_ != FarRound::kTaken && safety().timesRefused() == 0) {
      far_round_ = FarRound::kPassedOver;
      if (!takesWhatItPassedOver()) {
        (void)safety().refused();
      }
      return {};  // asked for narrower, or once more
    }
    learns_gusts_ = asked.level > 0 && weather().mayTurnOutStrong();
    if (learns_gusts_) {
      enter(phase_, "learns what gusts do before it goes through narrow water");
      return holdHere();
    }
    return setsOutMoving(m) ? Orders{} : sail(m, {plan.trajectory, m.now_s}, asked);
  }
  // What the hull goes at as it sets out it is off its way by a second later. Waves come and go,
  // and so does what the thrust that turned or held it has left; near something it doesn't wait.
  [[nodiscard]] bool setsOutMoving(const Moment& m) {
    constexpr double kMovesMps = 0.25;
    constexpr double kPatienceS = 3.0;
    if (vessel::speedOf(m.situation.state) < kMovesMps ||
        m.obstacles.clearance(m.situation.state.head<2>(), m.now_s) < vessel_.hull.length_m) {
      moves_since_s_.reset();
      return false;
    }
    moves_since_s_ = moves_since_s_.value_or(m.now_s);
    return m.now_s < *moves_since_s_ + kPatienceS;
  }
  // In strong wind, where plans are slow, by minutes: a narrower way comes before that.
  [[nodiscard]] bool leadsFarRound(const Moment& m, const planner::Plan& plan) {
    constexpr double kTimesStraight = 2.0;
    constexpr double kMoreM = 50.0;
    const double straight_m = (goal_.position - m.situation.state.head<2>()).norm();
    return weather().isStrong() &&
           trajectory::length(plan.trajectory) > kTimesStraight * straight_m + kMoreM;
  }
  // Nothing was left to try but that: it is asked for again.
  bool takesWhatItPassedOver() {
    if (far_round_ != FarRound::kPassedOver || !safety().atNarrowest()) {
      return false;
    }
    far_round_ = FarRound::kTaken;
    safety().tryWidest();
    return true;
  }
  [[nodiscard]] bool isForNarrowWater(const PlanRequests::Asked& asked) const {
    return asked.request.query.limits.clearance_m <
           centreClearance(vessel_.hull, feasibility::kPreferredBesideM);
  }
  // Not for ever: there are trackers that never tell.
  [[nodiscard]] bool mayLearnTheWaves(const Moment& m) const {
    constexpr double kPatienceS = 20.0;
    return !m.situation.disturbance.knows_waves &&
           m.now_s < waves_since_s_.value_or(m.now_s) + kPatienceS;
  }
  Orders takeMoving(const Moment& m, const planner::Plan& plan, const PlanRequests::Asked& asked) {
    constexpr double kLateM = 0.3;
    constexpr double kImproveShare = 0.05;   // of the time left, that an improvement saves
    constexpr double kFurtherM = 2.0;        // or leads so much nearer to the goal,
    constexpr double kFurtherShare = 0.1;    // or of what is left, if that is more
    constexpr double kRoomShare = 0.95;      // or leaves that much room
    constexpr double kRoomS = 40.0;          // for so long
    constexpr double kMoreToLeewardM = 1.0;  // or so much more to leeward
    constexpr double kLongerS = 2.0;         // that more room may cost
    TimedTrajectory next{plan.trajectory, asked.request.start_time_s};
    if (!asked.lead.trajectory.empty()) {
      std::vector<trajectory::Piece> pieces = asked.lead.trajectory.pieces();
      pieces.insert(pieces.end(), plan.trajectory.pieces().begin(), plan.trajectory.pieces().end());
      next = {Trajectory(std::move(pieces)), asked.lead.start_time_s};
    }
    const double starts = next.start_time_s;
    const double late = m.now_s - starts;
    const bool from_vessel = asked.from == From::kVessel;
    const Eigen::Vector2d there =
        from_vessel ? m.situation.state.head<2>() : sailed_.at(m.now_s).position;
    if (late > 0.0 && (next.trajectory.flat(late).position - there).norm() > kLateM) {
      plans_.latency.late(late);
      return asked.gain ? Orders{} : from_vessel ? askFromVessel(m) : planFromSailed(m);
    }
    if (next.start_time_s + next.trajectory.duration() > asked.ends_by_s) {
      return {};
    }
    // Not with thrust that wind and current take.
    const auto lacks_thrust = [&] {
      const vessel::Disturbance& planned = asked.request.query.limits.disturbance;
      return overtaxed(m.now_s, next, vessel_, weather().mean()) >
             std::max(overtaxed(m.now_s, next, vessel_, planned),
                      overtaxed(m.now_s, sailed_.path, vessel_, weather().mean())) +
                 kOvertaxedLongerS;
    };
    const bool saves_time =
        next.left(m.now_s) <= (1.0 - kImproveShare) * sailed_.path.left(m.now_s) && !lacks_thrust();
    const double further_m = std::max(kFurtherM, kFurtherShare * sailed_.plan.left_m);
    const bool leads_on = asked.left_m < sailed_.plan.left_m - further_m ||
                          (asked.left_m == 0.0 && sailed_.plan.left_m > 0.0);
    const auto has_room = [&] {
      return safety().plansWithWeather()
                 ? wayAhead(m).leavesRoomOn(next, kRoomShare, kRoomS)
                 : seaRoom(m).toLeeward(next, kRoomS) >=
                       seaRoom(m).toLeeward(sailed_.path, kRoomS) + kMoreToLeewardM;
    };
    const auto uses_wide_water = [&] {
      return next.left(m.now_s) <= sailed_.path.left(m.now_s) + kLongerS && !lacks_thrust() &&
             wayAhead(m).leastRoom(next, starts) >=
                 wayAhead(m).leastRoom(sailed_.path, starts) + kMoreRoomM;
    };
    const auto keeps_off = [&] {
      const WayAhead ahead = wayAhead(m);
      constexpr double kMostM = feasibility::kPreferredBesideM;
      const double before_m = ahead.leastBeside(sailed_.path, starts, kBesideAheadS, kMostM);
      return next.left(m.now_s) <= sailed_.path.left(m.now_s) + kLongerS && !lacks_thrust() &&
             ahead.leastBeside(next, starts, kBesideAheadS, kMostM) >=
                 std::min(before_m + kMoreBesideM, kMostM) - 1e-6;
    };
    const bool is_better = saves_time || asked.gain == Gain::kThrust ||
                           (asked.gain == Gain::kRoom && has_room()) ||
                           (asked.gain == Gain::kClearance && uses_wide_water()) ||
                           (asked.gain == Gain::kBeside && keeps_off());
    if (asked.gain && !leads_on && (asked.left_m > sailed_.plan.left_m || !is_better)) {
      return {};
    }
    plans_.latency.onTime();
    if (from_vessel) {
      return sail(m, std::move(next), asked);
    }
    return sail(m, stopping::splice(sailed_.path, m.now_s, next), asked);
  }
  Orders planFailed(const Moment& m, const std::string& why, const PlanRequests::Asked& asked) {
    if (asked.gain) {
      return {};
    }
    if (asked.from == From::kRest && takesWhatItPassedOver()) {
      return {};
    }
    const bool more = safety().refused();
    // One that knows nothing of the weather is no better than the one being sailed; and looking on
    // and on for one, the vessel would see to nothing else.
    const bool in_vain = safety().plansWithWeather() ? safety().plansBlind() : !more;
    if (replansForLoad() && in_vain) {
      return keepThePlan(m);
    }
    if (more && asked.from == From::kSailed && phase_ == Phase::kReplanning) {
      return planFromSailed(m);  // at once: there is less room with each update
    }
    if (asked.from != From::kRest || more) {
      return {};  // asked again at the next update, as long as there is room
    }
    // Where it did so before, a way on with less around the hull comes first.
    if (!hasFault(m) && !(plans_.knowsDeadEndAt(bowOf(m)) && safety().mayKeepLess())) {
      if (std::optional<Trajectory> path =
              stopping::backOff(withoutSwing(m), m.obstacles.startingAt(m.now_s), vessel_,
                                m.situation.disturbance.mean, safety().reach())) {
        noteDeadEnd(m);
        return manoeuvre(m, Phase::kBackingOff, std::move(*path), "no room to turn: " + why,
                         Cause::kClearance);
      }
    }
    if (mayPass(m)) {
      retries_.pause(m.now_s);
      return sailed_.isEmpty() ? holdHere() : Orders{};
    }
    if (retries_.roundLost(m.now_s)) {
      return sailed_.isEmpty() ? holdHere() : Orders{};
    }
    return enter(Phase::kFailed,
                 text("no plan after %d rounds: ", retries_.rounds()) + why +
                     text(" (at %.2f m clearance)", asked.request.query.limits.clearance_m));
  }

  // Before the bow, where it can't go on. Other vessels may have been why.
  void noteDeadEnd(const Moment& m) {
    if (m.situation.tracks.empty()) {
      plans_.addDeadEnd(bowOf(m));
    }
  }
  [[nodiscard]] Eigen::Vector2d bowOf(const Moment& m) const {
    const vessel::State& x = m.situation.state;
    return x.head<2>() + 0.5 * vessel_.hull.length_m * unitVector(x[vessel::kPsi]);
  }

  // Other vessels near, that leave no plan now: no round is lost to them, but not for ever.
  bool mayPass(const Moment& m) {
    constexpr double kPatienceS = 60.0;
    return m.now_s - sailed_since_s_ <= kPatienceS && others_.passNear(m);
  }

  SupervisorOptions options_;
  vessel::Parameters vessel_;

  Phase phase_ = Phase::kIdle;
  std::string reason_;
  vessel::Pose goal_;
  Sailed sailed_;
  double nearest_left_m_ = std::numeric_limits<double>::infinity();  // where a part of it ended
  double felt_s_ = -std::numeric_limits<double>::infinity();
  std::optional<double> across_since_s_;  // at rest, not bow to a firm load
  bool holds_ = false;                    // the tracker was told to keep the place
  Trajectory other_stop_;                 // that is milder
  double stops_looked_for_s_ = -std::numeric_limits<double>::infinity();
  std::optional<Trajectory> aside_;  // out of another vessel's way, if that is asked for
  bool is_aside_ = false;            // and is being sailed
  bool makes_room_ = false;          // so, before it plans
  bool escapes_ = false;             // an escape is being sailed
  int rooms_made_ = 0;               // since a plan was sailed
  double calmer_by_s_ = 0.0;         // until then it waits for less wind
  std::optional<double> calm_by_s_;  // or the mission fails
  double too_fast_since_s_ = 0.0;
  stopping::Conflict conflict_;     // what the last condition found on the way
  double sailed_since_s_ = 0.0;     // when a plan was taken last, or the goal
  double stop_time_s_ = 0.0;        // when the vessel began to come to rest
  bool cancelled_ = false;          // the mission ends with the stop
  std::string end_reason_;          // by whose wish
  std::optional<Phase> suspended_;  // what the vessel is to rest in, with its mission kept
  Cause cause_ = Cause::kOther;
  Replans replans_;
  PlanRequests plans_;
  Stops stops_;
  RetryBudget retries_;
  Following following_;
  Driven driven_;
  BetterPlans better_;
  Others others_;
  std::optional<Following::Later> later_;  // for a vessel that is behind
  std::optional<double> waves_since_s_;    // it learns them
  std::optional<double> moves_since_s_;    // it is to set out from rest, and moves
  bool learns_gusts_ = false;
  enum class FarRound { kNotMet, kPassedOver, kTaken };
  FarRound far_round_ = FarRound::kNotMet;
  std::optional<encounter::Manoeuvre> way_made_;  // what the last decision found
};

}  // namespace

const char* name(Phase phase) {
  constexpr const char* kNames[] = {"idle",    "planning",    "sailing", "replanning",   "stopping",
                                    "stopped", "backing off", "evading", "turning back", "paused",
                                    "holding", "arrived",     "failed"};
  return kNames[static_cast<std::size_t>(phase)];
}

std::unique_ptr<Supervisor> Supervisor::create(const SupervisorOptions& options,
                                               const vessel::Parameters& vessel,
                                               std::uint64_t seed) {
  return std::make_unique<Decider>(options, vessel, seed);
}

}  // namespace otter_nav::mission
