#include "otter_nav/mission/supervisor.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "goal_check.hpp"
#include "moment.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/text.hpp"
#include "otter_nav/encounter/evasion.hpp"
#include "otter_nav/encounter/lying_off.hpp"
#include "otter_nav/encounter/surprise.hpp"
#include "otter_nav/stopping/back_off.hpp"
#include "otter_nav/stopping/braking.hpp"
#include "otter_nav/stopping/escape.hpp"
#include "otter_nav/stopping/splice.hpp"
#include "otter_nav/stopping/stand_aside.hpp"
#include "otter_nav/stopping/watch.hpp"
#include "otter_nav/vessel/hull.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "otter_nav/vessel/thrusters.hpp"
#include "plan_requests.hpp"
#include "retry_budget.hpp"
#include "sea_room.hpp"
#include "stops.hpp"

namespace otter_nav::mission {
namespace {

using feasibility::Obstacles;
using trajectory::TimedTrajectory;
using trajectory::Trajectory;

bool atRest(const vessel::State& state) {
  constexpr double kAtRestMps = 0.2;
  constexpr double kAtRestRadps = 0.1;
  return vessel::speedOf(state) < kAtRestMps && std::abs(state[vessel::kYawRate]) < kAtRestRadps;
}

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
constexpr double kEvadeAgainS = 0.25;  // from one decision about others to the next
constexpr double kSettleS = 10.0;      // at a trajectory's end
// What the thrusters lack for so much longer on one way than on another makes a difference.
constexpr double kOvertaxedLongerS = 1.5;

// Why a plan is given up, or the vessel stops: something in the way, or the weather's doing, by
// which the vessel is off its way, wants for thrust on it, or can't hold the goal's heading.
enum class Cause { kOther, kClearance, kOff, kLoad, kGoalHeading };

// What a plan was made for, and with.
struct Planned {
  double left_m = 0.0;  // of the way, from its end to the goal
  bool is_last_resort = false;
  std::size_t level = 0;  // of the clearances
  int steps_wider = 0;    // than that (ClearanceLevels)
  double clearance_m = 0.0;
  double thrust_share = 1.0;
  double pace_share = 1.0;           // of the usual speed
  double speed_limit_mps = 0.0;      // the mission's
  feasibility::SafetyLimits limits;  // all of it
  double goal_psi_rad = 0.0;
  vessel::Disturbance disturbance;
  double overtaxed_s = 0.0;  // for so long that takes more than the thrusters have
  bool in_known_weather = false;
  bool in_unknown_water = false;
  bool among_others = false;
};

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
        pilot_(options.encounter, vessel),
        evasion_(vessel) {}

  Result<Orders> setGoal(double now_s, const vessel::Pose& goal, const Situation& situation,
                         const Obstacles& obstacles) override {
    const Moment m = momentOf(now_s, situation, obstacles);
    if (const Status status = checkGoal(goal, m.obstacles, safety().narrowest()); !status) {
      return failure(status.error().message);
    }
    goal_ = goal;
    planned_.goal_psi_rad = goal.psi_rad;
    calm_by_s_.reset();
    way_.clear();
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
    pilot_.newGoal(m.now_s);
    lying_off_.newGoal();
    return handedOut(m, follow(kGoalRules, m));
  }

  Orders cancel(double now_s, const Situation& situation, const Obstacles& obstacles,
                std::string why) override {
    const Moment m = momentOf(now_s, situation, obstacles);
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
    return suspend(momentOf(now_s, situation, obstacles), Phase::kPaused);
  }
  Orders hold(double now_s, const Situation& situation, const Obstacles& obstacles) override {
    return suspend(momentOf(now_s, situation, obstacles), Phase::kHolding);
  }
  Result<Orders> resume(double now_s, const Situation& situation,
                        const Obstacles& obstacles) override {
    const Moment m = momentOf(now_s, situation, obstacles);
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
    const Moment m = momentOf(now_s, situation, obstacles);
    feel(m);
    lookOut(m);
    return handedOut(m, plans_.overdue(now_s)
                            ? planFailed(m, "no answer from the planner", plans_.take())
                            : follow(kRules, m));
  }

  Orders planFinished(double now_s, int id, const planner::Plan& plan, const Situation& situation,
                      const Obstacles& obstacles) override {
    const Moment m = momentOf(now_s, situation, obstacles);
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
  [[nodiscard]] const TimedTrajectory& sailed() const override { return sailed_; }
  [[nodiscard]] const std::optional<TimedTrajectory>& lastStop() const override {
    return stops_.kept();
  }
  [[nodiscard]] double plannedClearance() const override { return planned_.clearance_m; }
  [[nodiscard]] std::vector<encounter::Encounter> encounters() const override {
    return pilot_.encounters();
  }
  [[nodiscard]] Replans replans() const override { return replans_; }
  [[nodiscard]] int stops() const override { return retries_.stops(); }

 private:
  // With other vessels among the obstacles, until the next call.
  Moment momentOf(double now_s, const Situation& situation, const Obstacles& obstacles) {
    if (situation.tracks.empty()) {
      near_.reset();
      return {now_s, situation, obstacles};
    }
    near_.emplace(now_s, situation.tracks);
    seen_.emplace(obstacles);
    seen_->add(*near_);
    return {now_s, situation, *seen_};
  }
  Orders handedOut(const Moment& m, Orders orders) {
    if (orders.plan && near_) {
      orders.plan->others = *near_;
    }
    if (orders.sail || orders.stop) {
      given_s_ = m.now_s;
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

  bool isAtTheEnd(const Moment& m) { return sailed_.left(m.now_s) <= 0.0; }
  bool liesAtTheGoal(const Moment& m) {
    const vessel::State& x = m.situation.state;
    return (x.head<2>() - goal_.position).norm() <= options_.arrival_distance_m &&
           vessel::speedOf(x) <= vessel::kRestMps;
  }
  // By whatever way.
  bool isThere(const Moment& m) {
    return liesAtTheGoal(m) &&
           (headingOff(m) <= options_.arrival_heading_rad || goalHeadingYields());
  }
  bool hasArrived(const Moment& m) {
    return isAtTheEnd(m) && (isThere(m) || (liesAtTheGoal(m) && doesNotComeRound(m)));
  }
  // Its way is over, and it lies in the wind with the goal's heading beyond abeam of it, where
  // strong wind takes the moment that the next try would need as well.
  bool doesNotComeRound(const Moment& m) {
    return mayLoseItsHeading() && sailed_.left(m.now_s) <= -kSettleS && headingOff(m) > 0.5 * kPi &&
           isHeldInWind(m.situation.state[vessel::kPsi]);
  }
  // A trajectory that ends elsewhere belongs to a goal that was replaced: nothing to wait for.
  bool settlesNoMore(const Moment& m) {
    constexpr double kElsewhereM = 0.5;
    if (!isAtTheEnd(m)) {
      return false;
    }
    const Trajectory& path = sailed_.trajectory;
    return sailed_.left(m.now_s) <= -kSettleS ||
           ((path.flat(path.duration()).position - goal_.position).norm() > kElsewhereM &&
            atRest(m.situation.state));
  }

  // Less than what the plan was made with, or the hull's outline comes too near. Sensed outlines
  // wander by about a cell: less than that is no ground for another plan.
  bool isNarrow(const Moment& m) {
    constexpr double kSlackM = 0.3;
    const double at = sailed_.elapsed(m.now_s);
    conflict_ = stopping::firstConflict(sailed_.trajectory, at, alongSailed(m),
                                        planned_.clearance_m - kSlackM);
    const double until = conflict_.found ? conflict_.time_s : sailed_.trajectory.duration();
    const stopping::Conflict hull =
        stopping::outlineConflict(sailed_.trajectory, at, until, alongSailed(m), vessel_,
                                  safety().critical(), true, planned_.limits.disturbance);
    conflict_ = hull.found ? hull : conflict_;
    return conflict_.found;
  }
  // As it truly lies, and not as it was planned; or what lies still, on the way that the tracker
  // foresees, which knows what drives it.
  bool isAboutToTouch(const Moment& m) {
    constexpr double kForeseesS = 4.0;
    if (isAtTheEnd(m)) {
      return false;
    }
    const vessel::Foreseen& foreseen = m.situation.foreseen;
    return stopping::isAboutToTouch(sailed_.trajectory, sailed_.elapsed(m.now_s), m.situation.state,
                                    alongSailed(m), vessel_, planned_.limits.disturbance) ||
           (foreseen.start_s >= given_s_ &&
            stopping::isAboutToTouch(foreseen, m.now_s, m.now_s + kForeseesS, m.situation.state,
                                     Obstacles(m.obstacles.field()), vessel_.hull));
  }
  // The way that is sailed keeps `clearance_m`, the margin round the hull and the room to leeward
  // that are asked for, at a speed for them: such a plan would have no more.
  bool hasRoomFor(const Moment& m, const feasibility::SafetyLimits& asked, double clearance_m) {
    constexpr double kAheadS = 30.0;
    constexpr double kStepM = 0.5;  // that room to leeward is measured in
    const double at = sailed_.elapsed(m.now_s);
    const double speed_mps = planned_.limits.speed_max_mps;
    return safety().paceAt(safety().level(), speed_mps) >= speed_mps &&
           !stopping::firstConflict(sailed_.trajectory, at, alongSailed(m), clearance_m).found &&
           !stopping::outlineConflict(sailed_.trajectory, at, sailed_.trajectory.duration(),
                                      alongSailed(m), vessel_,
                                      std::max(safety().critical(), asked.hull_margin_m), true,
                                      planned_.limits.disturbance)
                .found &&
           seaRoom(m).toLeeward(sailed_, kAheadS) >= asked.drift_m.norm() - kStepM;
  }
  bool isClearAgain(const Moment& m) { return cause_ == Cause::kClearance && !isNarrow(m); }
  // Of what is sailed; if there is one it is kept until the next is found.
  bool hasNoStop(const Moment& m) {
    return !stops_.find(m, sailed_, planned_.limits, offSailed(m));
  }
  // The hull does not pass on its way, no plan leads round that, and of the stops before it none
  // that begins later ends with as much beside the hull as the one that is kept: to go on only
  // leads into the narrow place.
  bool endsNarrowerLater(const Moment& m) {
    if (cause_ != Cause::kClearance || !stops_.kept() || mayPlanRoundIt(m)) {
      return false;
    }
    const stopping::Conflict hull = stopping::outlineConflict(
        sailed_.trajectory, sailed_.elapsed(m.now_s), sailed_.trajectory.duration(), alongSailed(m),
        vessel_, safety().critical(), true, planned_.limits.disturbance);
    return hull.found && stops_.endNarrowerThanKept(m, sailed_, planned_.limits, hull.time_s);
  }
  // From what is sailed, before that is not clear; until there was none at any clearance.
  bool mayPlanRoundIt(const Moment& m) {
    return safety().timesRefused() == 0 &&
           plans_.beginning(m.now_s, sailed_, sailed_.start_time_s + conflict_.time_s);
  }
  // The way to rest itself is not clear any more, or its end, and there is a milder one.
  bool hasMilderStop(const Moment& m) {
    constexpr double kAgainS = 0.2;
    if (sailed_.left(m.now_s) <= 0.0 || m.now_s - stops_looked_for_s_ < kAgainS) {
      return false;
    }
    const stopping::Off off = offSailed(m);
    const stopping::Touch now = stopping::firstTouch(sailed_.trajectory, sailed_.elapsed(m.now_s),
                                                     alongSailed(m), vessel_, off);
    if (std::isinf(now.after_s)) {
      return false;
    }
    stops_looked_for_s_ = m.now_s;
    other_stop_ = stops_.now(m, sailed_, planned_.limits, offSailed(m)).trajectory;
    return stopping::firstTouch(other_stop_, 0.0, m.obstacles.startingAt(m.now_s), vessel_, off)
        .milderThan(now);
  }
  // From a way to rest a plan may lead on.
  bool mayGoOn(const Moment& m) {
    return !cancelled_ && !suspended_ && !mustWait(m) && !hasFault(m) && !isBlind(m) &&
           !isFarOff(m) && sailed_.left(m.now_s) > 0.0;
  }
  // Other vessels ask for another way than the one being sailed.
  bool shouldMakeWay(const Moment& m) {
    if (m.situation.tracks.empty()) {
      return false;
    }
    const std::optional<double> joint = plans_.joint(m.now_s, sailed_);
    if (!joint) {
      return false;
    }
    way_made_ = pilot_.decide({m.now_s, sailed_, goal_.position, *joint, planned_.limits,
                               m.obstacles, PlanRequests::joiningSpeed(sailed_)});
    return way_made_.has_value();
  }
  // Of what is sailed. The tracker may speak of what it was given before still.
  double errorOf(const Moment& m) {
    constexpr double kSpeaksOfItS = 0.3;
    if (sailed_.trajectory.empty() || m.now_s - given_s_ > kSpeaksOfItS) {
      return m.situation.tracking_error_m;
    }
    const Eigen::Vector2d there = sailed_.trajectory.flat(sailed_.elapsed(m.now_s)).position;
    return std::min(m.situation.tracking_error_m, (m.situation.state.head<2>() - there).norm());
  }
  bool isFarOff(const Moment& m) { return errorOf(m) > mayBeOff(m); }
  // In strong wind another plan would meet the same gusts, and the hull comes back by itself: the
  // farther off it may be, the more is clear of what a lost heading takes, here and on its way.
  double mayBeOff(const Moment& m) {
    constexpr double kMostLengths = 1.25;  // where all of that is
    constexpr double kAheadS = 10.0;
    constexpr double kStepS = 1.0;
    const double least_m = options_.tracking_error_max_m;
    if (!mayLoseItsHeading() || sailed_.trajectory.empty()) {
      return least_m;
    }
    double clear_m = m.obstacles.clearance(m.situation.state.head<2>(), m.now_s);
    for (double later = 0.0; later <= kAheadS; later += kStepS) {
      const double then_s = m.now_s + later;
      const Eigen::Vector2d there = sailed_.trajectory.flat(sailed_.elapsed(then_s)).position;
      clear_m = std::min(clear_m, m.obstacles.clearance(there, then_s));
    }
    const double drift_m = weather().drift().norm();
    const double share = clear_m < drift_m ? clear_m / drift_m : 1.0;
    return std::max(least_m, share * kMostLengths * vessel_.hull.length_m);
  }
  double listedClearance(std::size_t level) const {
    const std::vector<double>& levels = options_.side_clearances_m;
    return centreClearance(vessel_.hull, levels[std::min(level, levels.size() - 1)]);
  }
  // Along its way, by more than waves swing it, and still more from moment to moment: with all its
  // thrust it can't keep up. The same way later is as clear, and can be followed. In strong wind
  // plans are slow, and what runs away from the hull draws it off the headings that a gust leaves
  // it. In a firm load it is not time alone that lacks there.
  bool fallsBehind(const Moment& m) {
    const bool strong = mayLoseItsHeading();
    const double least_m = strong ? 0.3 : 0.2;
    const double under_way_mps = strong ? 0.2 : 0.8;
    const vessel::State& x = m.situation.state;
    const vessel::FlatPoint wanted = sailed_.trajectory.flat(sailed_.elapsed(m.now_s));
    const double speed = wanted.velocity.norm();
    if (m.situation.tracking_error_m < least_m || speed < under_way_mps ||
        safety().plansWithWeather()) {
      return false;
    }
    const Eigen::Vector2d along = wanted.velocity / speed;
    const double behind_m = (wanted.position - x.head<2>()).dot(along);
    const Eigen::Vector2d velocity =
        Eigen::Rotation2D<double>(x[vessel::kPsi]) * x.segment<2>(vessel::kSurge);
    if (behind_m < least_m || velocity.dot(along) > speed) {
      return false;
    }
    later_ = sailed_;
    later_.start_time_s += behind_m / speed;
    behind_m_ = behind_m;
    return stops_.find(m, later_, planned_.limits, stopping::Off{});
  }
  // A plan that knows wind and current, made from where they have set the vessel, is one that it
  // can follow again: it need not be far off for that.
  bool isLeftBehind(const Moment& m) {
    constexpr double kShareWithWeather = 0.7;
    const double share = safety().plansWithWeather() ? kShareWithWeather : 1.0;
    return std::max(errorOf(m), lateBy(m.now_s)) > share * mayBeOff(m);
  }
  // By how much what is sailed was put off, of late: as if the vessel had made good 0.1 m/s of it.
  [[nodiscard]] double lateBy(double now_s) const {
    constexpr double kMadeGoodMps = 0.1;
    return std::max(late_m_ - kMadeGoodMps * (now_s - late_at_s_), 0.0);
  }
  // Broadside to where it should point and carried off.
  bool hasLostItsHeading(const Moment& m) {
    // Crabbing in a firm load the bow is far off the course anyhow.
    const double lost_rad = safety().plansWithWeather() ? 1.2 : 0.8;
    constexpr double kFirmShare = 0.25;  // of the thrust; with less the path wants no heading
    const trajectory::Sample wanted =
        sailed_.trajectory.sample(sailed_.elapsed(m.now_s), vessel_, planned_.disturbance);
    const bool spins = std::isinf(wanted.heading_force_n);
    const bool firm =
        spins ? vessel::canLie(vessel_.manoeuvring, weather().mean(), wanted.state[vessel::kPsi])
              : wanted.heading_force_n > kFirmShare * 2.0 * vessel_.thrusters.ahead_max_n;
    const double psi_rad = m.situation.state[vessel::kPsi];
    // In strong wind it is sailed on headings near the wind's line, bow or stern to it, whatever
    // the path's.
    const bool lies_in_wind = mayLoseItsHeading() && isHeldInWind(psi_rad);
    return weather().isKnown() && firm && !lies_in_wind && errorOf(m) > 0.5 * mayBeOff(m) &&
           std::abs(wrapAngle(psi_rad - wanted.state[vessel::kPsi])) > lost_rad;
  }
  bool mayLoseItsHeading() { return weather().isStrong(); }
  // Bow or stern to it, nearly: where its moment is small.
  bool isHeldInWind(double psi_rad) {
    constexpr double kHeldRad = 0.6;
    const double bow = vessel::headingIntoLoad(vessel_.manoeuvring, weather().mean(), psi_rad);
    return std::abs(std::sin(psi_rad - bow)) < std::sin(kHeldRad);
  }
  // It had to stop hereabouts before: in such a wind it waits longer each time, for less of it.
  bool waitsForLessWind(const Moment& m) { return mayLoseItsHeading() && m.now_s < calmer_by_s_; }
  // Off its trajectory, where nothing was verified, for longer than a plan takes, or towards
  // something near.
  bool isSetAside(const Moment& m) {
    constexpr double kPatienceS = 1.5;
    constexpr double kAheadS = 2.0;
    constexpr double kStepS = 0.25;
    if (!isFarOff(m)) {
      off_since_s_ = m.now_s;
    }
    // Where the wind can take the heading, with something near, a plan from there leads nowhere: at
    // rest, bow to it, there is a better. Unless the vessel is coming back. A gust lets go of it no
    // sooner than it lies so, and the sooner it turns the less way it has got: it is seen soon how
    // far off it will be.
    constexpr double kSoonS = 1.5;
    const vessel::State& x = m.situation.state;
    const double here = m.obstacles.clearance(x.head<2>(), m.now_s);
    const Eigen::Vector2d velocity =
        Eigen::Rotation2D<double>(x[vessel::kPsi]) * x.segment<2>(vessel::kSurge);
    const vessel::FlatPoint wanted = sailed_.trajectory.flat(sailed_.elapsed(m.now_s));
    const Eigen::Vector2d off = x.head<2>() - wanted.position;
    // Late on its way it is where nothing lies: what is sailed waits for it.
    const double speed = wanted.velocity.norm();
    const Eigen::Vector2d along =
        speed > 0.0 ? (wanted.velocity / speed).eval() : Eigen::Vector2d::Zero();
    const double made_good_mps = std::clamp(velocity.dot(along), 0.0, speed);
    const Eigen::Vector2d goes_off = velocity - made_good_mps * along;
    const bool hurries =
        mayLoseItsHeading() && off.dot(goes_off) >= 0.0 && seaRoom(m).hasALeeShore();
    if (hurries && (off + kSoonS * goes_off).norm() > options_.tracking_error_max_m) {
      return true;
    }
    if (errorOf(m) < 0.5 * mayBeOff(m)) {
      return false;
    }
    if (isFarOff(m) && m.now_s - off_since_s_ >= kPatienceS) {
      return true;
    }
    for (double later = kStepS; later <= kAheadS; later += kStepS) {
      const double there = m.obstacles.clearance(x.head<2>() + later * velocity, m.now_s + later);
      if (there < safety().critical() && there < here) {
        return true;
      }
    }
    return false;
  }
  // Bow or stern to it, with something near, or to leeward nearer than a lost heading takes, and a
  // better place ahead or astern.
  bool liesOffALeeShore(const Moment& m) {
    constexpr double kShorterM = 0.5;
    const Obstacles now = m.obstacles.startingAt(m.now_s);
    sea_room_m_ = weather().isKnown() ? seaRoom(m).toMake(retries_.stops()) : 0.0;
    // The bow comes farther than the centre, and something may move.
    while (sea_room_m_ != 0.0 && !stopping::backOffIsClear(legToMake(m), 0.0, now, vessel_)) {
      sea_room_m_ = std::copysign(std::max(0.0, std::abs(sea_room_m_) - kShorterM), sea_room_m_);
    }
    return sea_room_m_ != 0.0;
  }
  // So in strong wind, whether it lies still or not: holding the place against a gust takes the
  // moment that holds the heading, and to windward there is a way out.
  bool isDrivenAshore(const Moment& m) { return mayLoseItsHeading() && liesOffALeeShore(m); }
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
  // Something, by wind and current, in the seconds that the tracker foresees, while its thrust is
  // spent on turning the hull; and there are thrusts by which it passes. On a plan there may be
  // little room, and a load that turns no hull lets it keep its place with little; what is foreseen
  // soon after an escape from there is the same again. Where it lies bow to strong wind, and slowly
  // drifts onto something beyond those seconds, a way out is sought now: later there may be none.
  bool isDrivenOnto(const Moment& m) {
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
    const bool may_lose_heading = weather().isNearlyStrong();
    const bool is_escaping = escapes_ && phase_ == Phase::kBackingOff;
    const bool may_be_driven = may_lose_heading || safety().plansWithWeather();
    if (!may_be_driven || !knowsPlace(m) || foreseen.start_s < given_s_ ||
        m.now_s - escaped_s_ < (may_lose_heading || is_escaping ? kAgainS : kAnotherS)) {
      return false;
    }
    const vessel::State& x = m.situation.state;
    const vessel::Foreseen here{m.now_s, 0.0, {{x.head<2>(), x[vessel::kPsi]}}};
    const auto least = [&](const vessel::Foreseen& motion, double within_s) {
      return stopping::leastClearance(motion, m.now_s, m.now_s + within_s, m.obstacles,
                                      vessel_.hull);
    };
    const bool lies = may_lose_heading && (in(phase_)&kUnderWay) == 0;
    const double near_m = lies ? kNearM : kNearOnItsWayM;
    double comes_m = least(foreseen, kWithinS);
    if (lies && !is_escaping) {
      const double drifts_m = least(stopping::driftingOn(foreseen, m.now_s + kDriftsS), kDriftsS);
      comes_m = drifts_m < kDriftsOntoM ? std::min(comes_m, drifts_m) : comes_m;
    }
    if (comes_m > std::min(near_m, least(here, kWithinS) - kNearerM)) {
      return false;
    }
    escape_ =
        stopping::escape(x, m.obstacles.startingAt(m.now_s), vessel_, m.situation.disturbance.mean);
    return escape_.clearance_m > comes_m + kWorthM;
  }
  // Many others near, or one about to come too near: no time for plans to the goal.
  bool mustEvade(const Moment& m) {
    constexpr int kMany = 4;
    constexpr double kNearM = 35.0;
    constexpr double kSailsS = 6.0;  // ahead
    constexpr double kLiesS = 8.0;
    constexpr double kTooNearM = 0.8;
    const bool arrives = (in(phase_)&kUnderWay) != 0 && hasArrived(m);
    if (!near_ || !hasMission() || suspended_ || hasFault(m) || arrives || hasJustFoundNoWay(m)) {
      return false;
    }
    if (moversWithin(m, kNearM) >= kMany) {
      return true;
    }
    const std::vector<traffic::Track> movers = moversOf(m);
    if (movers.empty()) {
      return false;
    }
    const bool sails = !sailed_.trajectory.empty() && sailed_.left(m.now_s) > 0.0;
    const encounter::Danger danger =
        sails ? evasion_.danger(sailed_, m.now_s, kSailsS, movers)
              : evasion_.danger({m.situation.state.head<2>(), m.situation.state[vessel::kPsi]},
                                m.now_s, kLiesS, movers);
    return danger.gap_m < kTooNearM;
  }
  // Then the rules for who rests, or comes to rest, are followed for a moment.
  bool hasJustFoundNoWay(const Moment& m) {
    return (in(phase_)&kUnderWay) == 0 && m.now_s - no_way_s_ < kEvadeAgainS;
  }
  // Few others near, and none in the way.
  bool isAmongFew(const Moment& m) {
    constexpr int kFew = 2;
    constexpr double kNearM = 40.0;
    constexpr double kAheadS = 8.0;
    constexpr double kClearM = 2.0;
    return moversWithin(m, kNearM) <= kFew &&
           evasion_.danger(sailed_, m.now_s, kAheadS, moversOf(m)).gap_m > kClearM;
  }
  bool hasRoomAgain(const Moment& m) { return !plans_.waits() && isAmongFew(m); }
  // For so long that no plan from a moving vessel is to be hoped for.
  bool hasRoomInVain(const Moment& m) {
    constexpr double kPatienceS = 5.0;
    if (!isAmongFew(m)) {
      crowded_s_ = m.now_s;
    }
    return m.now_s - crowded_s_ > kPatienceS;
  }
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
                          : isHeldInWind(x[vessel::kPsi]);
    if ((still && lies) || !(safety().plansWithWeather() || mayLoseItsHeading())) {
      across_since_s_.reset();
      return false;
    }
    if (!across_since_s_) {
      across_since_s_ = m.now_s;
    }
    return m.now_s - *across_since_s_ < kPatienceS;
  }
  // On the way left the thrusters have not enough against what blows by now, for longer than when
  // it was planned. Once the weather is known, then not for each change again.
  bool lacksThrust(const Moment& m) {
    constexpr double kAgainS = 5.0;
    return mayReplanForWeather(m) && (replansForLoad() || m.now_s - weather_asked_s_ >= kAgainS) &&
           overtaxed(m.now_s, sailed_, weather().mean()) > planned_.overtaxed_s + kOvertaxedLongerS;
  }
  // At this speed gusts by now take the moment that holds the headings.
  bool isTooFastForGusts(const Moment& m) {
    constexpr double kAgainS = 10.0;
    constexpr double kWorthShare = 0.7;  // of the speed: slowing down for less isn't worth it
    constexpr double kLeftS = 5.0;
    const double planned_mps = planned_.limits.speed_max_mps;
    return mayReplanForWeather(m) && m.now_s - gusts_asked_s_ >= kAgainS &&
           sailed_.left(m.now_s) > kLeftS &&
           safety().sailingSpeed(planned_mps) < kWorthShare * planned_mps;
  }
  // The way left is faster than the thrust allows that waves leave, by what is known by now: behind
  // such a plan the vessel falls.
  bool isTooFastForWaves(const Moment& m) {
    constexpr double kAgainS = 2.0;
    constexpr double kWorthShare = 0.93;  // of the speed: slowing down for less isn't worth it
    constexpr double kLeftS = 4.0;
    return weather().knowsWaves() && m.now_s - slower_asked_s_ >= kAgainS &&
           sailed_.left(m.now_s) > kLeftS &&
           safety().speedInWaves() < kWorthShare * fastestAhead(m.now_s);
  }
  // The plan was made before it showed how far gusts and waves set the vessel aside; or where
  // something far off left no room for all that a lost heading takes to leeward.
  bool passesTooNear(const Moment& m) {
    constexpr double kAgainS = 5.0;
    constexpr double kLeftS = 4.0;
    constexpr double kShare = 0.85;  // for a little more it is not worth another plan
    constexpr double kAheadS = 30.0;
    if (m.now_s - wider_asked_s_ < kAgainS || sailed_.left(m.now_s) <= kLeftS) {
      return false;
    }
    if (safety().plansWithWeather()) {
      return !leavesRoom(m, sailed_, kShare, kAheadS);
    }
    return mayLoseItsHeading() && planned_.level > 0 &&
           seaRoom(m).toLeeward(sailed_, kAheadS) < kShare * weather().drift().norm();
  }
  // The plan ends on a heading that can't be held there, or not on the goal's though it can.
  bool endsOnAWrongHeading(const Moment& m) {
    constexpr double kWrongRad = 0.7;
    constexpr double kLeftS = 5.0;
    constexpr double kSoonS = 30.0;  // what the weather will be later nobody knows
    const double left_s = sailed_.left(m.now_s);
    return mayReplanForWeather(m) && left_s > kLeftS &&
           (left_s < kSoonS || !planned_.in_known_weather) && !staysOffGoalHeading() &&
           std::abs(wrapAngle(safety().restHeading(goal_.psi_rad) - planned_.goal_psi_rad)) >
               kWrongRad;
  }
  bool isBeyondThrust(const Moment& /*m*/) {
    const bool is = !safety().beyondThrust().empty();
    if (!is) {
      calm_by_s_.reset();
    }
    return is;
  }
  bool hasNewSpeedMax(const Moment& /*m*/) {
    return planned_.speed_limit_mps != safety().speedMax();
  }
  // A plan that slows down is to be had in time, or there is none.
  bool isTooFastForLong(const Moment& m) {
    constexpr double kPatienceS = 4.0;
    if (!isTooFast()) {
      too_fast_since_s_ = m.now_s;
    }
    return m.now_s - too_fast_since_s_ > kPatienceS;
  }
  // A plan with rests on its way, or a slow one, was the last resort, and may do with a better one
  // soon.
  bool mayImprove(const Moment& m) {
    constexpr double kLastResortS = 1.0;
    constexpr double kPartS = 2.0;  // what leads a part of the way
    constexpr double kCrawlingS = 2.0;
    constexpr double kCrowdedS = 3.0;
    const double last_resort = planned_.left_m > 0.0 ? kPartS : kLastResortS;
    const bool others_slow_it = m.now_s - plan_time_s_ >= kCrowdedS && waitsForOthers(m.now_s);
    const double usual = crawlsForRoom()  ? kCrawlingS
                         : others_slow_it ? kCrowdedS
                                          : options_.improve_period_s;
    const double period = planned_.is_last_resort ? last_resort : usual;
    return period > 0.0 && m.now_s - plan_time_s_ >= period && sailed_.left(m.now_s) > period;
  }
  // A plan that others drove to go slowly, though it may be fast: they will have gone soon.
  bool waitsForOthers(double now_s) const {
    constexpr double kLonger = 1.8;
    constexpr double kSpareS = 5.0;
    if (!planned_.among_others) {
      return false;
    }
    const double left_s = sailed_.left(now_s);
    const double at_most_m = planned_.limits.speed_max_mps * (left_s - kSpareS) / kLonger;
    return at_most_m > wayLeft(now_s);
  }
  double wayLeft(double now_s) const {
    constexpr double kStepS = 0.5;
    const Trajectory& path = sailed_.trajectory;
    double way_m = 0.0;
    for (double t = sailed_.elapsed(now_s); t < path.duration(); t += kStepS) {
      way_m += kStepS * path.flat(t).velocity.norm();
    }
    return way_m;
  }
  // Past the narrow place there may be a wider way, to be sailed faster.
  bool crawlsForRoom() const {
    return planned_.pace_share < 1.0 && planned_.level > 0 && !planned_.in_unknown_water;
  }
  // A plan was made slow while nobody knew the water or how the vessel wanders; now they do.
  bool isNeedlesslySlow(const Moment& m) {
    constexpr double kAgainS = 1.0;
    constexpr double kLeftS = 4.0;
    return m.now_s - plan_time_s_ >= kAgainS && sailed_.left(m.now_s) > kLeftS &&
           plans_.mayBeFaster(planned_.level, planned_.pace_share, m.situation.state, m.obstacles);
  }

  // A plan from a hull under way leads on in its course, and where that can't be turned, round what
  // lies there.
  bool goesFarRound(const Moment& m) {
    constexpr double kTimesStraight = 2.0;
    constexpr double kMoreM = 30.0;
    constexpr double kAgainS = 10.0;
    const double straight_m = (goal_.position - m.situation.state.head<2>()).norm();
    return m.now_s - stopping_asked_s_ >= kAgainS && !mayLoseItsHeading() &&
           !safety().plansWithWeather() && wayLeft(m.now_s) > kTimesStraight * straight_m + kMoreM;
  }

  // What was free when it set off may not be any more: the water astern is the less known.
  bool isBlocked(const Moment& m) {
    const double at = sailed_.elapsed(m.now_s);
    const auto clear =
        phase_ == Phase::kBackingOff ? stopping::backOffIsClear : stopping::turnBackIsClear;
    // Halfway out of another's way is the worst place to stop, and an escape is found anew.
    const Obstacles obstacles = is_aside_ ? Obstacles(m.obstacles.field()) : alongSailed(m);
    return !escapes_ && at < sailed_.trajectory.duration() &&
           !clear(sailed_.trajectory, at, obstacles, vessel_);
  }
  bool isStillMoving(const Moment& m) {
    constexpr double kPatienceS = 15.0;
    const bool rests = knowsPlace(m) && atRest(m.situation.state);
    const bool waits = !rests && m.now_s - stop_time_s_ < kPatienceS;
    return sailed_.trajectory.empty() ? waits && !isDriven(m) : waits || !isAtTheEnd(m);
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
    return {plans_.fromRest(m.now_s, withoutSwing(m), goal_, m.obstacles), {}, false};
  }
  // Nothing if the vessel is about to come to rest: what comes then is for the rules at the
  // trajectory's end, or for the brake.
  Orders planFromSailed(const Moment& m) {
    constexpr double kForGustsShare = 0.7;  // of the room that they need, which is known roughly
    // What comes into the way before it rests is no reason to plan from there.
    const bool in_the_way = phase_ == Phase::kReplanning && conflict_.found;
    const double rests_by_s = in_the_way ? sailed_.start_time_s + conflict_.time_s
                                         : std::numeric_limits<double>::infinity();
    Orders orders{
        plans_.fromSailed(m.now_s, sailed_, planned_.thrust_share, goal_, m.obstacles, rests_by_s),
        {},
        false};
    if (!orders.plan) {
      safety().tryWidest();  // too fast for this level, perhaps for a while: the others first
    }
    if (orders.plan && phase_ == Phase::kReplanning && cause_ == Cause::kClearance) {
      const feasibility::SafetyLimits& asked = orders.plan->query.limits;
      const double listed_m = std::min(listedClearance(safety().level()), asked.clearance_m);
      const double enough_m = listed_m + kForGustsShare * (asked.clearance_m - listed_m);
      if (hasRoomFor(m, asked, enough_m)) {
        planned_.clearance_m = std::min(planned_.clearance_m, enough_m);
        return keepThePlan(m);
      }
    }
    return orders;
  }
  Orders makeWay(const Moment& m) {
    TimedTrajectory path = std::move(way_made_->path);
    if (!way_made_->to_the_goal) {
      Orders orders{plans_.onward(m.now_s, std::move(path), planned_.thrust_share,
                                  planned_.limits.speed_max_mps, goal_, m.obstacles),
                    {},
                    false};
      plans_.markAsWorthless(m.now_s + way_made_->worth_s);
      return orders;
    }
    plans_.drop();
    ++replans_.all;
    const double catch_up_mps = sailed_.speed_max_mps;
    sailed_ = stopping::splice(sailed_, m.now_s, path);
    sailed_.speed_max_mps = catch_up_mps;
    enter(Phase::kSailing);
    return {std::nullopt, sailed_, false};
  }
  Orders planFromFarOff(const Moment& m) {
    if (phase_ == Phase::kSailing) {  // not for each attempt again
      safety().leftBehind(m.now_s);
    }
    late_m_ = 0.0;
    return planFromVessel(m, "far off the trajectory", Cause::kOff);
  }
  Orders planForWeather(const Moment& m) {
    weather_asked_s_ = m.now_s;
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
    gusts_asked_s_ = m.now_s;
    replan(text("gusts take the moment that holds headings at %.1f m/s",
                planned_.limits.speed_max_mps),
           Cause::kLoad);
    Orders orders = planFromSailed(m);
    return orders.plan ? orders : enter(Phase::kSailing);
  }
  Orders planForSpeedMax(const Moment& m) {
    if (isTooFast()) {
      replan(text("the speed limit is %.2f m/s now", safety().speedMax()));
      return planFromSailed(m);
    }
    planned_.speed_limit_mps = safety().speedMax();
    Orders orders = planToImprove(m);
    // Nor when it is behind.
    feasibility::SafetyLimits catching_up;
    catching_up.speed_max_mps = sailed_.speed_max_mps;
    catching_up.limitSpeed(safety().speedMax());
    if (catching_up.speed_max_mps < sailed_.speed_max_mps) {
      sailed_.speed_max_mps = catching_up.speed_max_mps;
      orders.sail = sailed_;
    }
    return orders;
  }
  Orders planFaster(const Moment& m) {
    safety().tryLevel(planned_.level, planned_.steps_wider);
    return improve(m);
  }
  Orders planSlower(const Moment& m) {
    slower_asked_s_ = m.now_s;
    safety().tryLevel(planned_.level, planned_.steps_wider);
    return improve(m, Gain::kThrust);
  }
  // The widest way first; then one like that being sailed, with more beside the hull.
  Orders planWider(const Moment& m) {
    wider_asked_s_ = m.now_s;
    const std::size_t like_it =
        safety().plansWithWeather() || planned_.level == 0 ? planned_.level : planned_.level - 1;
    safety().tryLevel(std::exchange(asks_widest_, !asks_widest_) ? 0 : like_it);
    return improve(m, Gain::kRoom);
  }
  // A stop first, and from there a plan as from rest, if that is sooner at the goal.
  Orders planByStopping(const Moment& m) {
    stopping_asked_s_ = m.now_s;
    const double soon = sailed_.elapsed(m.now_s + plans_.latency.seconds());
    stopping::Braking braking = stops_.from(m, sailed_, soon, safety().stop(planned_.limits));
    if (!braking.clear) {
      return {};
    }
    safety().tryLevel(planned_.level, planned_.steps_wider);
    Orders orders{
        plans_.onward(m.now_s, {std::move(braking.trajectory), sailed_.start_time_s + soon},
                      planned_.thrust_share, planned_.limits.speed_max_mps, goal_, m.obstacles),
        {},
        false};
    safety().tryWidest();
    plans_.markAsImprovement(Gain::kTime);
    return orders;
  }
  Orders planToImprove(const Moment& m) {
    if (planned_.is_last_resort) {
      safety().tryLevel(planned_.level);
    } else if (crawlsForRoom()) {
      safety().tryLevel(std::exchange(asks_widest_, !asks_widest_) ? 0 : planned_.level - 1);
    }
    return improve(m);
  }
  Orders improve(const Moment& m, Gain gain = Gain::kTime) {
    if (gain != Gain::kRoom) {  // which is no reason for the weather to wait
      plan_time_s_ = m.now_s;
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
    if (planned_.left_m > 0.0 && planned_.left_m < nearest_left_m_ - kNearerM) {
      nearest_left_m_ = planned_.left_m;  // as far as it was planned: no stop that counts
      retries_.madeGood(m.now_s);
      safety().tryWidest();
      return enter(Phase::kStopped, text("%.0f m of the way are to be planned", planned_.left_m));
    }
    const std::string why =
        text("not settled at the trajectory's end: %.2f m and %.2f rad from the goal, at %.2f m/s",
             (m.situation.state.head<2>() - goal_.position).norm(), headingOff(m),
             vessel::speedOf(m.situation.state));
    cause_ = Cause::kOff;
    return rest(m, why, why);
  }

  Orders arrive(const Moment& m) {
    if (headingOff(m) <= options_.arrival_heading_rad) {
      return enter(Phase::kArrived);
    }
    const std::string off =
        text("%.2f m from the goal (%.2f m allowed), but %.2f rad off its heading: ",
             (m.situation.state.head<2>() - goal_.position).norm(), options_.arrival_distance_m,
             headingOff(m));
    if (!goalHeadingYields()) {
      return enter(Phase::kArrived, off + text("the wind takes %.0f N m of the %.0f N m "
                                               "that turn the hull round",
                                               weather().greatestMoment(),
                                               vessel::greatestMoment(vessel_.thrusters)));
    }
    const bool in_gusts = mayLoseItsHeading();
    const vessel::Disturbance load = in_gusts ? weather().gust() : weather().mean();
    return enter(Phase::kArrived,
                 off +
                     text("wind and current would set the vessel aside by %.2f m/s on it",
                          vessel::setAside(vessel_.manoeuvring, load, goal_.psi_rad)) +
                     (in_gusts ? " in gusts" : ""));
  }
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
    if (!kept || (place(*kept) - place(sailed_)).norm() > kApartM) {
      return brakeFor(m, std::move(why), cause);
    }
    plans_.drop();
    cause_ = cause;
    stop_time_s_ = m.now_s;
    sailed_ = *kept;
    enter(Phase::kStopping, std::move(why));
    return {std::nullopt, sailed_, false};
  }
  Orders changeTheStop(const Moment& m) {
    plans_.drop();  // what is asked for begins on the other
    sailed_ = {std::move(other_stop_), m.now_s};
    return {std::nullopt, sailed_, false};
  }
  Orders sailLater(const Moment& m) {
    // Another plan would be as late in a gust; a vessel that makes no way at all gets one.
    constexpr double kGustShare = 0.25;
    late_m_ = lateBy(m.now_s) + (mayLoseItsHeading() ? kGustShare : 1.0) * behind_m_;
    late_at_s_ = m.now_s;
    sailed_ = later_;
    return {std::nullopt, sailed_, false};
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
    Orders orders = manoeuvre(m, Phase::kBackingOff, legToMake(m),
                              text("makes room, %.1f m %s", std::abs(sea_room_m_),
                                   sea_room_m_ > 0.0 ? "ahead" : "astern"),
                              Cause::kOff);
    makes_room_ = true;
    return orders;
  }
  Orders escape(const Moment& m) {
    escaped_s_ = m.now_s;
    (void)manoeuvre(m, Phase::kBackingOff, std::move(escape_.path),
                    "out of what wind and current drive it onto", Cause::kOff);
    escapes_ = true;
    sailed_.rolled_out = true;
    return {std::nullopt, sailed_, false};
  }
  Orders standAside(const Moment& m) {
    Orders orders =
        manoeuvre(m, Phase::kBackingOff, std::move(*aside_), "out of another vessel's way");
    is_aside_ = true;
    return orders;
  }
  Orders evade(const Moment& m) {
    constexpr double kWorthS = 0.4;  // another way: tracks wander
    constexpr double kWorthAPlanS = 4.0;
    constexpr double kLeastLeftS = 4.0;
    constexpr double kLeastAgainS = 0.06;  // a scan of the lidar
    const bool evades = phase_ == Phase::kEvading;
    const bool under_way = (in(phase_)&kUnderWay) != 0;
    const double since_s = m.now_s - evaded_s_;
    if (evades && since_s < kEvadeAgainS &&
        (since_s < kLeastAgainS ||
         !surprise_.isNear(m.situation.state.head<2>(), m.situation.tracks))) {
      return {};
    }
    evaded_s_ = m.now_s;
    surprise_.decided(m.situation.tracks);
    encounter::Evasion::Task task = evasionFrom(m);
    // Not into water that nobody has seen, unless it lies in such.
    constexpr double kInKnownM = 0.5;
    const map::DistanceField& known = m.obstacles.inKnownWater().field();
    const bool in_known = known.clearance(task.start.position) > kInKnownM;
    const map::DistanceField& still = in_known ? known : m.obstacles.field();
    if (const auto off = lying_off_.place(m.now_s, task.start.position, goal_.position,
                                          m.situation.tracks, still, evasion_)) {
      task.goal = {*off, safety().restHeading(task.state[vessel::kPsi])};
      task.way.clear();
      task.arrival_m = task.arrival_rad = 0.0;
    }
    const encounter::Evasion::Way found = evasion_.find(task, m.situation.tracks, still);
    const bool from_sailed = task.start_s > m.now_s;
    if (evades && from_sailed && sailed_.left(m.now_s) > kLeastLeftS) {
      const double kept = evasion_.judge(task, sailed_, m.situation.tracks, still).price;
      if (kept < found.price + (plans_.waits() ? kWorthAPlanS : kWorthS)) {
        return {};
      }
    }
    if (found.path.trajectory.empty()) {
      no_way_s_ = m.now_s;
      return under_way ? takeLastStop(m, "no way among other vessels", Cause::kOther) : Orders{};
    }
    plans_.drop();  // what is asked for begins on what was sailed
    if (!evades) {
      stop_time_s_ = m.now_s;
      is_aside_ = makes_room_ = escapes_ = holds_ = false;
      cause_ = Cause::kOther;
      planned_.clearance_m = 0.0;
      crowded_s_ = m.now_s;
    }
    enter(Phase::kEvading, text("among %zu other vessels, the nearest %.1f m beside the way",
                                m.situation.tracks.size(), found.danger.gap_m));
    sailed_ = from_sailed ? stopping::splice(sailed_, m.now_s, found.path) : found.path;
    sailed_.speed_max_mps = task.speed_max_mps;
    return {std::nullopt, sailed_, false};
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
    constexpr int kRoomsMost = 3;  // before another plan is sailed; then it leads nowhere
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
      if (!sailed_.trajectory.empty() && sailed_.elapsed(felt_s_) >= 0.0) {
        const vessel::State there =
            sailed_.trajectory.sample(sailed_.elapsed(felt_s_), vessel_, planned_.disturbance)
                .state;
        if (hasMission()) {  // else anybody may move it
          safety().wander(felt_s_, (state.head<2>() - there.head<2>()).norm());
        }
        sway_mps = there[vessel::kSway];
      }
      safety().feelSway(felt_s_, state[vessel::kSway] - sway_mps);
    }
  }
  double headingOff(const Moment& m) {
    return std::abs(wrapAngle(m.situation.state[vessel::kPsi] - goal_.psi_rad));
  }
  bool goalHeadingYields() {
    constexpr double kSameRad = 1e-3;
    return weather().isKnown() &&
           (std::abs(wrapAngle(safety().restHeading(goal_.psi_rad) - goal_.psi_rad)) > kSameRad ||
            staysOffGoalHeading());
  }
  // The plan gave the goal's heading up, and its own can be held: in strong wind the hull is not
  // turned round as soon as the wind slackens or veers. The next gust would take the heading again.
  bool staysOffGoalHeading() {
    return mayLoseItsHeading() &&
           std::abs(wrapAngle(planned_.goal_psi_rad - goal_.psi_rad)) >
               options_.arrival_heading_rad &&
           vessel::canLie(vessel_.manoeuvring, weather().mean(), planned_.goal_psi_rad);
  }
  // At once when the weather is known first, later not before the plan has been sailed a while.
  bool mayReplanForWeather(const Moment& m) {
    constexpr double kAgainS = 10.0;
    return weather().isKnown() && (!planned_.in_known_weather || m.now_s - plan_time_s_ >= kAgainS);
  }
  // For that share of how far the vessel wanders by now, on the stretch of the way until then.
  bool leavesRoom(const Moment& m, const TimedTrajectory& path, double share, double ahead_s) {
    const double from = path.elapsed(m.now_s);
    const double to = std::min(path.trajectory.duration(), from + ahead_s);
    return !stopping::outlineConflict(path.trajectory, from, to,
                                      m.obstacles.startingAt(path.start_time_s), vessel_,
                                      share * safety().reach(), true, weather().mean())
                .found;
  }
  // The highest speed on the way left, m/s, from where a slower plan could have an effect.
  double fastestAhead(double now_s) {
    constexpr double kStepS = 0.5;
    constexpr double kAheadS = 20.0;
    const double from = sailed_.elapsed(now_s) + 1.0;
    const double to = std::min(sailed_.trajectory.duration(), from + kAheadS);
    double fastest = 0.0;
    for (double t = from; t < to; t += kStepS) {
      fastest = std::max(fastest, sailed_.trajectory.flat(t).velocity.norm());
    }
    return fastest;
  }
  // For how long, s, the way left on `path` asks for more than the thrusters have.
  double overtaxed(double now_s, const TimedTrajectory& path,
                   const vessel::Disturbance& disturbance) {
    constexpr double kStepS = 0.25;
    constexpr double kAheadS = 30.0;
    const double from = path.elapsed(now_s);
    const double to = std::min(path.trajectory.duration(), from + kAheadS);
    double longer = 0.0;
    for (double t = from; t < to; t += kStepS) {
      const vessel::Thrusts thrusts = path.trajectory.sample(t, vessel_, disturbance).thrusts;
      longer += vessel::thrustMargin(thrusts, vessel_.thrusters) < 0.0 ? kStepS : 0.0;
    }
    return longer;
  }
  [[nodiscard]] SeaRoom seaRoom(const Moment& m) { return {m, safety(), vessel_.hull}; }
  Trajectory legToMake(const Moment& m) {
    return seaRoom(m).leg(withoutSwing(m).head<2>(), sea_room_m_);
  }
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
    constexpr double kCruiseShare = 0.99;  // of the speed that plans may have
    evasion_.observe(m.situation.tracks);
    const bool has_met = !pilot_.encounters().empty();
    const bool has_way = !sailed_.trajectory.empty();
    if (!knowsPlace(m) || !(has_met || (has_way && !m.situation.tracks.empty()))) {
      return;
    }
    const vessel::State& x = m.situation.state;
    const Eigen::Rotation2D<double> map_from_base(x[vessel::kPsi]);
    const bool follows =
        has_way && m.situation.tracking_error_m < 0.5 * options_.tracking_error_max_m;
    const Eigen::Vector2d steered =
        follows ? sailed_.trajectory.flat(sailed_.elapsed(m.now_s)).position : x.head<2>();
    pilot_.observe(m.now_s, {x.head<2>(), map_from_base * x.segment<2>(vessel::kSurge)}, steered,
                   underWay(m.situation.tracks), goal_.position,
                   kCruiseShare * planned_.limits.speed_max_mps);
  }
  // Who lies there is passed as any other thing is.
  static std::vector<traffic::Track> underWay(const std::vector<traffic::Track>& tracks) {
    std::vector<traffic::Track> some;
    std::copy_if(tracks.begin(), tracks.end(), std::back_inserter(some),
                 [](const traffic::Track& track) { return !track.keeps_place; });
    return some;
  }
  static std::vector<traffic::Track> moversOf(const Moment& m) {
    std::vector<traffic::Track> movers;
    std::copy_if(m.situation.tracks.begin(), m.situation.tracks.end(), std::back_inserter(movers),
                 [](const traffic::Track& track) { return track.makesWay(); });
    return movers;
  }
  static int moversWithin(const Moment& m, double range_m) {
    const Eigen::Vector2d here = m.situation.state.head<2>();
    return static_cast<int>(std::count_if(
        m.situation.tracks.begin(), m.situation.tracks.end(), [&](const traffic::Track& track) {
          return track.makesWay() && (track.position - here).norm() < range_m;
        }));
  }
  // A little ahead on what is sailed, or where the hull is if it is off that or lies still.
  encounter::Evasion::Task evasionFrom(const Moment& m) {
    constexpr double kAheadS = 0.15;
    constexpr double kOffM = 0.5;
    constexpr double kStillMps = 0.3;
    encounter::Evasion::Task task;
    const vessel::State& x = m.situation.state;
    const double at = sailed_.trajectory.empty() ? 0.0 : sailed_.elapsed(m.now_s + kAheadS);
    if (!sailed_.trajectory.empty() && at < sailed_.trajectory.duration() && at >= 0.0 &&
        m.situation.tracking_error_m < kOffM) {
      const trajectory::Sample sample = sailed_.trajectory.sample(at, vessel_);
      task.start_s = m.now_s + kAheadS;
      task.start = sample.flat;
      task.state = sample.state;
      task.thrusts = sample.thrusts;
      if (!std::isinf(sample.heading_force_n)) {
        task.state[vessel::kPsi] = x[vessel::kPsi] + kAheadS * x[vessel::kYawRate];
      }
    } else {
      task.start_s = m.now_s;
      task.start.position = x.head<2>();
      task.state = x;
      if (vessel::speedOf(x) < kStillMps) {
        task.state.tail<3>().setZero();
      }
      task.start.velocity =
          Eigen::Rotation2D<double>(x[vessel::kPsi]) * task.state.segment<2>(vessel::kSurge);
    }
    task.disturbance = weather().mean();
    feasibility::SafetyLimits limits =
        feasibility::SafetyLimits::of(vessel_, 0.0, safety().calmThrustShare());
    limits.limitSpeed(safety().speedMax());
    task.speed_max_mps = std::min(limits.speed_max_mps, safety().speedInWaves());
    // From the nearest point of the way on.
    auto nearest = way_.begin();
    for (auto it = way_.begin(); it != way_.end(); ++it) {
      nearest = (*it - task.start.position).norm() < (*nearest - task.start.position).norm()
                    ? it
                    : nearest;
    }
    task.way.assign(nearest, way_.end());
    task.goal = {goal_.position, safety().restHeading(goal_.psi_rad)};
    task.arrival_m = options_.arrival_distance_m;
    task.arrival_rad = options_.arrival_heading_rad;
    return task;
  }
  // Of a plan that leads to the goal.
  void rememberTheWay() {
    constexpr double kApartM = 3.0;
    way_.clear();
    const double end = sailed_.trajectory.duration();
    for (double t = 0.0; t < end; t += 0.5) {
      const Eigen::Vector2d there = sailed_.trajectory.flat(t).position;
      if (way_.empty() || (there - way_.back()).norm() > kApartM) {
        way_.push_back(there);
      }
    }
  }
  bool knowsPlace(const Moment& m) {
    return m.situation.state.allFinite() &&
           m.now_s - m.situation.odometry_stamp_s <= options_.odometry_timeout_s;
  }
  // Where the hull lies but for the waves that swing it abeam, which the tracker leaves it to at
  // crawling pace. What begins at the end of a swing would be off by all of it half a wave later,
  // and by half of it from its middle.
  static vessel::State withoutSwing(const Moment& m) {
    constexpr double kOldS = 0.5;
    const vessel::Foreseen& foreseen = m.situation.foreseen;
    vessel::State x = m.situation.state;
    if (!foreseen.poses.empty() && std::abs(foreseen.start_s - m.now_s) < kOldS) {
      const Eigen::Vector2d port = across(unitVector(x[vessel::kPsi]));
      const double swing_m = port.dot(foreseen.poses.front().position - x.head<2>());
      x.head<2>() += std::clamp(swing_m, -stopping::kSwingsM, stopping::kSwingsM) * port;
    }
    return x;
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
    feasibility::SafetyLimits limits = planned_.limits;
    limits.limitSpeed(safety().speedMax());
    return limits.speed_max_mps < planned_.limits.speed_max_mps;
  }
  Obstacles alongSailed(const Moment& m) { return m.obstacles.startingAt(sailed_.start_time_s); }
  stopping::Off offSailed(const Moment& m) {
    if (sailed_.trajectory.empty() || !m.situation.state.allFinite()) {
      return {};
    }
    return stopping::offTrajectory(sailed_.trajectory, sailed_.elapsed(m.now_s), m.situation.state,
                                   vessel_, planned_.limits.disturbance);
  }
  // What the hull is off its way to rest it is off the plan at first, and more while it makes that
  // good in a bend: whether what lies still leaves as much beside the plan.
  bool hasRoomForWhatItIsOff(const Moment& m, const TimedTrajectory& path,
                             const feasibility::SafetyLimits& planned) {
    constexpr double kUntilMadeGoodS = 5.0;
    const stopping::Off off = offSailed(m);
    const double off_m = off.position_m.norm() +
                         vessel::circumscribedRadius(vessel_.hull) * std::abs(off.heading_rad);
    const double at = path.elapsed(m.now_s);
    return !stopping::outlineConflict(path.trajectory, at, at + kUntilMadeGoodS,
                                      Obstacles(m.obstacles.field()), vessel_, off_m, true,
                                      planned.disturbance)
                .found;
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
    const bool for_weather = asked.gain ? *asked.gain != Gain::kTime
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
    return {};
  }
  // Only if a stop exists on it; else it is asked for again, or the vessel stops.
  Orders sail(const Moment& m, TimedTrajectory plan, const PlanRequests::Asked& asked) {
    const bool from_sailed = asked.from == From::kSailed;
    const feasibility::SafetyLimits& planned = asked.request.query.limits;
    const bool gives_up_a_stop = phase_ == Phase::kStopping && from_sailed;
    if (gives_up_a_stop && !hasRoomForWhatItIsOff(m, plan, planned)) {
      return {};  // asked for again, from where it is less
    }
    // That on what was sailed is none on this one.
    std::optional<TimedTrajectory> last = stops_.kept();
    stops_.forget();
    if ((gives_up_a_stop && !stops_.existForAWhile(m, plan, planned)) ||
        !stops_.find(m, plan, planned, from_sailed ? offSailed(m) : stopping::Off{})) {
      stops_.keep(std::move(last));
      return asked.gain ? Orders{} : planFailed(m, "no stop in water known to be free", asked);
    }
    countReplan(asked);
    sailed_ = std::move(plan);
    sailed_.speed_max_mps = asked.catch_up_mps;
    planned_ = plannedAs(m, asked);
    if (planned_.left_m == 0.0) {
      rememberTheWay();
    }
    too_fast_since_s_ = m.now_s;
    plan_time_s_ = sailed_since_s_ = m.now_s;
    holds_ = is_aside_ = makes_room_ = escapes_ = false;
    rooms_made_ = 0;
    far_round_ = FarRound::kNotMet;
    safety().planTaken();
    enter(Phase::kSailing);
    return {std::nullopt, sailed_, false};
  }
  // What is sailed, as it was asked for.
  Planned plannedAs(const Moment& m, const PlanRequests::Asked& asked) {
    const planner::Query& query = asked.request.query;
    Planned planned;
    planned.left_m = asked.left_m;
    planned.is_last_resort =
        asked.slow || asked.left_m > 0.0 || stopping::restsBeforeItsEnd(sailed_.trajectory);
    planned.level = asked.level;
    planned.steps_wider = asked.steps_wider;
    planned.clearance_m = query.limits.clearance_m;
    planned.thrust_share = asked.request.thrust_share;
    planned.pace_share = asked.pace_share;
    planned.speed_limit_mps = asked.speed_max_mps;
    planned.limits = query.limits;
    planned.goal_psi_rad = query.goal.psi_rad;
    planned.disturbance = weather().mean();
    planned.overtaxed_s = overtaxed(m.now_s, sailed_, planned.disturbance);
    planned.in_known_weather = weather().isKnown();
    planned.in_unknown_water = asked.in_unknown_water;
    planned.among_others = near_ && !near_->empty();
    return planned;
  }
  // A way to rest, without a plan; an empty one is the tracker's to find.
  Orders manoeuvre(const Moment& m, Phase phase, Trajectory path, std::string reason,
                   Cause cause = Cause::kOther) {
    plans_.drop();
    cause_ = cause;
    stop_time_s_ = m.now_s;
    is_aside_ = makes_room_ = escapes_ = false;
    planned_.clearance_m = 0.0;
    enter(phase, std::move(reason));
    if (path.empty()) {
      sailed_ = {};
      holds_ = true;
      return {std::nullopt, std::nullopt, true};
    }
    sailed_ = {std::move(path), m.now_s};
    return {std::nullopt, sailed_, false};
  }
  Orders stopByItself(const Moment& m, std::string reason, Cause cause = Cause::kOther) {
    return manoeuvre(m, Phase::kStopping, {}, std::move(reason), cause);
  }
  Orders brakeFor(const Moment& m, std::string reason, Cause cause = Cause::kOther) {
    return manoeuvre(m, Phase::kStopping,
                     stops_.now(m, sailed_, planned_.limits, offSailed(m)).trajectory,
                     std::move(reason), cause);
  }
  // Plans from rest come next, unless there were too many stops.
  Orders rest(const Moment& m, const std::string& reason, const std::string& last) {
    const double left_m = (m.situation.state.head<2>() - goal_.position).norm();
    if (!retries_.stopped(m.now_s, left_m)) {
      return enter(Phase::kFailed, last);
    }
    safety().comeToRest();
    constexpr double kCalmerS = 10.0;
    constexpr double kCalmerMostS = 60.0;
    if (mayLoseItsHeading()) {
      calmer_by_s_ = m.now_s + std::min(kCalmerMostS, kCalmerS * (retries_.stops() - 1));
    }
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
    if (!safety().mayPlanWithWeather() || vessel::speedOf(m.situation.state) < kMovesMps ||
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
    return mayLoseItsHeading() &&
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
    constexpr double kNarrowM = 0.3;  // beside the hull
    return asked.request.query.limits.clearance_m < centreClearance(vessel_.hull, kNarrowM);
  }
  // Not for ever: there are trackers that never tell.
  [[nodiscard]] bool mayLearnTheWaves(const Moment& m) const {
    constexpr double kPatienceS = 20.0;
    return !m.situation.disturbance.knows_waves &&
           m.now_s < waves_since_s_.value_or(m.now_s) + kPatienceS;
  }
  Orders takeMoving(const Moment& m, const planner::Plan& plan, const PlanRequests::Asked& asked) {
    constexpr double kLateM = 0.3;
    constexpr double kImproveShare = 0.05;  // of the time left, that an improvement saves
    constexpr double kFurtherM = 2.0;       // or leads so much nearer to the goal,
    constexpr double kFurtherShare = 0.1;   // or of what is left, if that is more
    constexpr double kRoomShare = 0.95;     // or leaves that much room
    constexpr double kRoomS = 40.0;         // for so long
    constexpr double kMoreRoomM = 1.0;      // or so much more to leeward
    TimedTrajectory next{plan.trajectory, asked.request.start_time_s};
    if (!asked.lead.trajectory.empty()) {
      std::vector<trajectory::Piece> pieces = asked.lead.trajectory.pieces();
      pieces.insert(pieces.end(), plan.trajectory.pieces().begin(), plan.trajectory.pieces().end());
      next = {Trajectory(std::move(pieces)), asked.lead.start_time_s};
    }
    const double starts = next.start_time_s;
    const double late = m.now_s - starts;
    const bool from_vessel = asked.from == From::kVessel;
    const Eigen::Vector2d there = from_vessel
                                      ? m.situation.state.head<2>()
                                      : sailed_.trajectory.flat(sailed_.elapsed(m.now_s)).position;
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
      return overtaxed(m.now_s, next, weather().mean()) >
             std::max(overtaxed(m.now_s, next, planned),
                      overtaxed(m.now_s, sailed_, weather().mean())) +
                 kOvertaxedLongerS;
    };
    const bool saves_time =
        late + next.trajectory.duration() <= (1.0 - kImproveShare) * sailed_.left(m.now_s) &&
        !lacks_thrust();
    const double further_m = std::max(kFurtherM, kFurtherShare * planned_.left_m);
    const bool leads_on = asked.left_m < planned_.left_m - further_m ||
                          (asked.left_m == 0.0 && planned_.left_m > 0.0);
    const auto has_room = [&] {
      return safety().plansWithWeather() ? leavesRoom(m, next, kRoomShare, kRoomS)
                                         : seaRoom(m).toLeeward(next, kRoomS) >=
                                               seaRoom(m).toLeeward(sailed_, kRoomS) + kMoreRoomM;
    };
    const bool is_better =
        saves_time || asked.gain == Gain::kThrust || (asked.gain == Gain::kRoom && has_room());
    if (asked.gain && !leads_on && (asked.left_m > planned_.left_m || !is_better)) {
      return {};
    }
    plans_.latency.onTime();
    if (from_vessel) {
      return sail(m, std::move(next), asked);
    }
    return sail(m, stopping::splice(sailed_, m.now_s, next), asked);
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
      return sailed_.trajectory.empty() ? holdHere() : Orders{};
    }
    if (retries_.roundLost(m.now_s)) {
      return sailed_.trajectory.empty() ? holdHere() : Orders{};
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
    constexpr double kNearM = 5.0;
    constexpr double kAheadS = 8.0;
    if (!near_ || near_->empty() || m.now_s - sailed_since_s_ > kPatienceS) {
      return false;
    }
    for (double t = 0.0; t <= kAheadS; t += 1.0) {
      if (near_->clearance(m.situation.state.head<2>(), m.now_s + t) < kNearM) {
        return true;
      }
    }
    return false;
  }

  SupervisorOptions options_;
  vessel::Parameters vessel_;

  Phase phase_ = Phase::kIdle;
  std::string reason_;
  vessel::Pose goal_;
  TimedTrajectory sailed_;
  Planned planned_;                                                  // what is sailed
  double nearest_left_m_ = std::numeric_limits<double>::infinity();  // where a part of it ended
  double felt_s_ = -std::numeric_limits<double>::infinity();
  double off_since_s_ = 0.0;              // far off the trajectory
  double sea_room_m_ = 0.0;               // to be made
  std::optional<double> across_since_s_;  // at rest, not bow to a firm load
  bool holds_ = false;                    // the tracker was told to keep the place
  Trajectory other_stop_;                 // that is milder
  double stops_looked_for_s_ = -std::numeric_limits<double>::infinity();
  std::optional<Trajectory> aside_;  // out of another vessel's way, if that is asked for
  bool is_aside_ = false;            // and is being sailed
  bool makes_room_ = false;          // so, before it plans
  stopping::Escape escape_;          // that was found
  bool escapes_ = false;             // and is being sailed
  double escaped_s_ = -std::numeric_limits<double>::infinity();
  int rooms_made_ = 0;               // since a plan was sailed
  double calmer_by_s_ = 0.0;         // until then it waits for less wind
  std::optional<double> calm_by_s_;  // or the mission fails
  double too_fast_since_s_ = 0.0;
  stopping::Conflict conflict_;  // what the last condition found on the way
  double plan_time_s_ = 0.0;     // when the plan was taken, or an improvement asked for
  // When the tracker was given what is sailed, or to stop.
  double given_s_ = -std::numeric_limits<double>::infinity();
  // When a plan was asked for that leaves the waves what they take.
  double slower_asked_s_ = -std::numeric_limits<double>::infinity();
  // When one was asked for with more room, and whether the next is to be the widest.
  double wider_asked_s_ = -std::numeric_limits<double>::infinity();
  bool asks_widest_ = true;
  // When one was asked for that begins with a stop.
  double stopping_asked_s_ = -std::numeric_limits<double>::infinity();
  double sailed_since_s_ = 0.0;     // when a plan was taken last, or the goal
  double stop_time_s_ = 0.0;        // when the vessel began to come to rest
  bool cancelled_ = false;          // the mission ends with the stop
  std::string end_reason_;          // by whose wish
  std::optional<Phase> suspended_;  // what the vessel is to rest in, with its mission kept
  Cause cause_ = Cause::kOther;
  double weather_asked_s_ = 0.0;
  Replans replans_;
  PlanRequests plans_;
  Stops stops_;
  RetryBudget retries_;
  std::optional<encounter::NearFuture> near_;  // other vessels now
  std::optional<Obstacles> seen_;              // and what lies still
  encounter::Pilot pilot_;
  encounter::Evasion evasion_;
  encounter::LyingOff lying_off_;
  encounter::Surprise surprise_;
  TimedTrajectory later_;  // what is sailed, for a vessel that is so far behind:
  double behind_m_ = 0.0;
  double late_m_ = 0.0;  // what was put off in all, less what counts as made good since
  double late_at_s_ = 0.0;
  double gusts_asked_s_ = -std::numeric_limits<double>::infinity();  // for a slower plan
  std::optional<double> waves_since_s_;                              // it learns them
  std::optional<double> moves_since_s_;  // it is to set out from rest, and moves
  bool learns_gusts_ = false;
  enum class FarRound { kNotMet, kPassedOver, kTaken };
  FarRound far_round_ = FarRound::kNotMet;
  double evaded_s_ = -std::numeric_limits<double>::infinity();  // when it was decided last
  double crowded_s_ = 0.0;  // while she evades: when others were many or near last
  double no_way_s_ = -std::numeric_limits<double>::infinity();  // and nothing was found
  std::vector<Eigen::Vector2d> way_;              // that the last plan to the goal took
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
