#include "otter_nav/encounter/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

#include "encounter/candidates.hpp"
#include "encounter/manoeuvre.hpp"
#include "encounter/prospect.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/text.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::encounter {
namespace {

constexpr double kCourseS = 2.0;  // courses over ground are means over this
// A candidate must be better than what is being sailed by this, s: its polyline is only roughly
// what would be sailed, and tracks wander.
constexpr double kBetterS = 6.0;
constexpr double kPeriodS = 1.0;
constexpr double kNever = 1e18;
constexpr double kUnderWayS = 15.0;  // at most, until the cruising speed is reached
constexpr double kSteadiesS = 8.0;   // at least, until a course is kept

// A straight line through the positions of the last while: a track's own velocity follows each
// scan and wanders more than a course kept does.
class SteadyLine {
 public:
  void restart(double now_s) {
    *this = SteadyLine();
    since_s_ = now_s;
  }
  void add(double now_s, const Eigen::Vector2d& position) {
    constexpr double kMemoryS = 20.0;
    const double step = weight_ > 0.0 ? now_s - last_s_ : 0.0;
    if (weight_ > 0.0 && step <= 0.0) {
      return;
    }
    last_s_ = now_s;
    // Moments about now, older ones counting less.
    time2_ += step * (step * weight_ - 2.0 * time_);
    cross_ -= step * sum_;
    time_ -= step * weight_;
    const double keep = std::exp(-step / kMemoryS);
    weight_ = keep * weight_ + 1.0;
    time_ *= keep;
    time2_ *= keep;
    sum_ = keep * sum_ + position;
    cross_ *= keep;
  }
  [[nodiscard]] double span() const { return last_s_ - since_s_; }
  // Once there is enough of it.
  [[nodiscard]] std::optional<Eigen::Vector2d> velocity() const {
    constexpr double kEnoughS = 5.0;
    const double spread = weight_ * time2_ - time_ * time_;
    if (span() < kEnoughS || spread < 1e-6) {
      return std::nullopt;
    }
    return Eigen::Vector2d((weight_ * cross_ - time_ * sum_) / spread);
  }

 private:
  double since_s_ = 0.0;
  double last_s_ = 0.0;
  double weight_ = 0.0;
  double time_ = 0.0;
  double time2_ = 0.0;
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d cross_ = Eigen::Vector2d::Zero();
};

// How fast waves move the hull to the side of what is steered, means over 2 s as courses are.
class Swing {
 public:
  // So far, m/s: what it often reaches. `off` is the hull's place from where it is steered.
  double seen(double now_s, const Eigen::Vector2d& off, const Eigen::Vector2d& steered_mps) {
    constexpr double kMemoryS = 30.0;
    constexpr double kUsuallyAtMostMps = 0.3;  // what is more is no wave
    constexpr double kPeak = 1.5;              // of the root of the mean square
    const double dt = trail_.empty() ? 0.0 : now_s - trail_.back().first;
    trail_.push_back({now_s, off});
    while (trail_.size() > 2 && now_s - trail_[1].first >= kCourseS - 1e-6) {
      trail_.pop_front();
    }
    const double span = now_s - trail_.front().first;
    const double speed = steered_mps.norm();
    if (dt > 0.0 && span > 0.5 * kCourseS && speed > kStillMps) {
      const double aside = cross(steered_mps, off - trail_.front().second) / (speed * span);
      const double square = std::pow(std::min(std::abs(aside), kUsuallyAtMostMps), 2);
      felt_s_ = std::min(kMemoryS, felt_s_ + dt);
      square_ += std::min(1.0, dt / felt_s_) * (square - square_);
    }
    return kPeak * std::sqrt(square_);
  }

 private:
  static constexpr double kStillMps = 0.3;
  std::deque<std::pair<double, Eigen::Vector2d>> trail_;
  double felt_s_ = 0.0;
  double square_ = 0.0;
};

// Where we were, and how we sailed.
struct Past {
  double time_s = 0.0;
  Motion own;
  bool under_way = false;
};

// What is remembered of a track.
struct Memory {
  traffic::Track track;
  Motion motion;  // now
  Record record;
  double began_s = 0.0;
  double followed_s = 0.0;
  double aspect_rad = 0.0;
  double seen_s = 0.0;
  SteadyLine line;
  double off_since_s = -1.0;  // since when its velocity isn't the line's; negative: it is
  double changed_s = -1.0;    // when it last left a line; negative: never since it was first seen
  double heard_s = 0.0;       // first
  bool met = false;           // there was a risk of collision once
  double acts_since_s = kNever;  // off the course or speed kept
};

// When a trajectory begins to brake for its end, where it may turn at rest for a while.
double arrivesFrom(const trajectory::Trajectory& sailed) {
  constexpr double kStepS = 0.25;
  constexpr double kRestMps = 0.1;
  constexpr double kSteadyMps = 0.01;
  double t = sailed.duration();
  double speed = 0.0;
  while (t > kStepS) {
    const double before = sailed.flat(t - kStepS).velocity.norm();
    if (before > kRestMps && before < speed + kSteadyMps) {
      break;
    }
    t -= kStepS;
    speed = before;
  }
  return t;
}

// A course of straight legs along a trajectory, from `from_s` on, times from `zero_s`.
Course along(const trajectory::TimedTrajectory& sailed, double from_s, double zero_s) {
  constexpr double kStepS = 1.0;
  constexpr double kOffM = 0.15;  // of the trajectory from a leg
  Course course;
  const double start = sailed.elapsed(from_s);
  const double end = sailed.trajectory.duration();
  const double shift = from_s - zero_s - start;
  const double arrives = arrivesFrom(sailed.trajectory);
  double t = std::clamp(start, 0.0, end);
  Eigen::Vector2d p = sailed.trajectory.flat(t).position;
  while (t < end - 1e-6) {
    const double limit = t < arrives - 1e-6 ? arrives : end;
    double next = std::min(limit, t + kStepS);
    Eigen::Vector2d q = sailed.trajectory.flat(next).position;
    // Doubled as long as the middle stays near.
    while (next < limit) {
      const double further = std::min(limit, t + 2.0 * (next - t));
      const Eigen::Vector2d r = sailed.trajectory.flat(further).position;
      const double share = (next - t) / (further - t);
      const double quarter = 0.5 * (t + next);
      if ((q - p - share * (r - p)).norm() > kOffM ||
          (sailed.trajectory.flat(quarter).position - p - 0.5 * share * (r - p)).norm() > kOffM) {
        break;
      }
      next = further;
      q = r;
    }
    course.legs.push_back({t + shift, p, (q - p) / (next - t)});
    t = next;
    p = q;
  }
  course.end_s = t + shift;
  course.arrives_s = arrives + shift;
  return course;
}

}  // namespace

std::string describe(const Encounter& e) {
  return text(
      "vessel %d: %s (rule %s), since %.0f s, when she bore %.0f deg and saw us at %.0f "
      "deg; %.0f m off, nearest %.0f m in %.0f s%s",
      e.id, name(e.role), rule(e.role), e.since_s, e.bearing_rad / kDegree, e.aspect_rad / kDegree,
      e.range_m, e.approach.distance_m, e.approach.time_s, e.acted ? ", acted" : "");
}

class Pilot::Impl {
 public:
  Impl(const Options& options, const vessel::Parameters& vessel)
      : options_(options), vessel_(vessel), chooser_(options, vessel) {}

  void newGoal(double now_s) {
    past_.clear();
    goal_time_s_ = now_s;
    under_way_ = false;
    decided_s_ = -1e9;
    act_by_s_ = kNever;
  }

  void observe(double now_s, const Motion& own, const Eigen::Vector2d& steered,
               const std::vector<traffic::Track>& tracks, const Eigen::Vector2d& goal,
               double cruise_mps) {
    now_s_ = now_s;
    remember(now_s, own, steered, goal, cruise_mps);
    chooser_.feel(swing_.seen(now_s, own.position - steered, own_.velocity));
    const Past now{now_s, own_, under_way_};
    const auto known = [&](const traffic::Track& track) { return memories_.count(track.id) > 0; };
    std::vector<traffic::Track> fresh;
    std::copy_if(tracks.begin(), tracks.end(), std::back_inserter(fresh), std::not_fn(known));
    for (const traffic::Track& track : tracks) {
      if (known(track)) {
        see(now_s, track);
      }
    }
    for (const traffic::Track& track : fresh) {
      see(now_s, track);
    }
    for (auto it = memories_.begin(); it != memories_.end();) {
      constexpr double kForgottenS = 30.0;
      it = now_s - it->second.seen_s > kForgottenS ? memories_.erase(it) : std::next(it);
    }
    for (auto& [id, memory] : memories_) {
      if (isLost(memory)) {
        continue;
      }
      if (!memory.met && now_s - memory.heard_s < kPastS) {
        recall(memory);
      }
      follow(now, memory.motion, memory);
      memory.met = memory.met || memory.record.role != Role::kNone;
    }
    if (past_.empty() || now_s - past_.back().time_s >= kPastStepS - 1e-6) {
      past_.push_back(now);
    }
    while (now_s - past_.front().time_s > kPastS) {
      past_.pop_front();
    }
  }

  std::optional<Manoeuvre> decide(const Outset& outset) {
    if (memories_.empty() || outset.now_s - decided_s_ < kPeriodS) {
      return std::nullopt;
    }
    decided_s_ = outset.now_s;
    if (mayHaveToStandOn()) {
      return std::nullopt;
    }
    const double zero = outset.now_s;
    constexpr double kBeginsMore = 1.05;  // what is sailed follows the legs but roughly
    Water water{outset.obstacles.field(),       outset.limits.clearance_m, {}, {}, 0.0,
                kBeginsMore * outset.begins_mps};
    water.sailed = along(outset.sailed, outset.joint_s, zero);
    water.cruise_mps = cruiseOf(water.sailed);
    if (water.sailed.legs.empty() || water.sailed.legs.front().velocity.norm() < 0.3) {
      return std::nullopt;
    }
    const std::vector<Other> others = othersNow(water.field);
    const double keep = chooser_.price(water.sailed, others, 1e9);
    // Nothing to gain: nobody near, and the way is as straight as it can be.
    const double straight =
        water.sailed.legs.front().from_s +
        (outset.goal - water.sailed.legs.front().position).norm() / water.cruise_mps;
    if (keep < straight + kBetterS) {
      act_by_s_ = kNever;
      return std::nullopt;
    }
    for (const Leg& leg : water.sailed.legs) {
      if (water.path.empty() || (leg.position - water.path.back()).norm() > 5.0) {
        water.path.push_back(leg.position);
      }
    }
    if (!water.path.empty()) {
      water.path.erase(water.path.begin());
    }
    water.path.push_back(outset.goal);
    constexpr std::size_t kTried = 4;
    const bool may_wait = outset.now_s < act_by_s_;
    for (const Choice& choice : chooser_.choose(water, others, kTried, may_wait, !listens())) {
      if (choice.price + kBetterS >= keep) {
        break;  // not worth it
      }
      if (choice.intent.wait_s > kPeriodS) {
        // Once put off it is not put off again: there would be no end to it.
        act_by_s_ = std::min(act_by_s_, outset.now_s + choice.intent.wait_s);
        break;
      }
      if (std::optional<Manoeuvre> manoeuvre = realise(outset, water, choice, others, keep)) {
        act_by_s_ = kNever;
        return manoeuvre;
      }
    }
    return std::nullopt;
  }

  std::vector<Encounter> encounters() const {
    std::vector<Encounter> all;
    for (const auto& [id, memory] : memories_) {
      if (memory.record.role == Role::kNone || isLost(memory)) {
        continue;
      }
      Encounter e;
      e.id = id;
      e.role = memory.record.role;
      e.since_s = memory.began_s;
      e.bearing_rad = memory.record.bearing_rad;
      e.aspect_rad = memory.aspect_rad;
      e.range_m = (memory.motion.position - own_.position).norm();
      e.approach = nearestApproach(own_, memory.motion);
      e.acted = memory.record.acted;
      all.push_back(e);
    }
    return all;
  }

 private:
  // Our own course as a mean; while getting under way, the course and speed we are about to have.
  // As it is steered: that waves swing the hull is no action, and no course to be kept either.
  void remember(double now_s, const Motion& own, const Eigen::Vector2d& steered,
                const Eigen::Vector2d& goal, double cruise_mps) {
    cruise_mps_ = cruise_mps;
    trail_.push_back({now_s, steered});
    while (trail_.size() > 2 && now_s - trail_[1].first >= kCourseS - 1e-6) {
      trail_.pop_front();
    }
    const double span = now_s - trail_.front().first;
    own_ = own;
    if (span > 0.5) {
      own_.velocity = (steered - trail_.front().second) / span;
    }
    constexpr double kCruising = 0.92;
    const double sails_s = now_s - goal_time_s_;
    const bool cruises = own_.velocity.norm() > kCruising * cruise_mps && sails_s > kSteadiesS;
    under_way_ = under_way_ || cruises || sails_s > kUnderWayS;
    if (!under_way_ && (goal - own.position).norm() > 1.0) {
      own_.velocity = cruise_mps * (goal - own.position).normalized();
    }
  }

  void see(double now_s, const traffic::Track& track) {
    // A velocity hardly known yet tells of no course: only who is near counts then.
    constexpr double kHardlyKnownMps = 0.45;
    constexpr double kNearM = 40.0;
    if (memories_.find(track.id) == memories_.end() &&
        std::max(track.covariance(2, 2), track.covariance(3, 3)) >
            kHardlyKnownMps * kHardlyKnownMps &&
        (track.position - own_.position).norm() > kNearM) {
      return;
    }
    const auto [place, first] = memories_.try_emplace(track.id);
    Memory& memory = place->second;
    const auto was = first ? lostAs(now_s, track) : memories_.end();
    if (was != memories_.end()) {
      memory = was->second;
      memories_.erase(was);
      memory.line.restart(now_s);
    } else if (first) {
      memory.line.restart(now_s);
      memory.heard_s = now_s;
    }
    memory.track = track;
    memory.seen_s = now_s;
    memory.motion = Motion{track.position, track.velocity}.after(now_s - track.stamp_s);
    if (goesRound(track)) {
      memory.line.restart(now_s);
      memory.changed_s = now_s;
      return;
    }
    memory.line.add(now_s, memory.motion.position);
    const std::optional<Eigen::Vector2d> steady = memory.line.velocity();
    if (!steady) {
      return;
    }
    constexpr double kOffMps = 0.2;
    constexpr double kSigmas = 1.5;
    constexpr double kOffS = 1.5;
    const double deviation = std::sqrt(std::max(track.covariance(2, 2), track.covariance(3, 3)));
    const bool off =
        (track.velocity - *steady).norm() > kOffMps + 0.1 * steady->norm() + kSigmas * deviation;
    memory.off_since_s = !off ? -1.0 : memory.off_since_s < 0.0 ? now_s : memory.off_since_s;
    if (off && now_s - memory.off_since_s >= kOffS) {
      memory.changed_s = now_s;
      memory.off_since_s = -1.0;
      memory.line.restart(now_s);
      memory.line.add(now_s, memory.motion.position);
      return;
    }
    memory.motion.velocity = *steady;
  }

  // She turns, and has done so for a while.
  static bool goesRound(const traffic::Track& track) {
    constexpr double kTurnsRadps = 0.04;
    constexpr double kLongS = 20.0;
    constexpr double kLeastMps = 0.3;
    return std::abs(track.turn_rate_radps) > kTurnsRadps && track.turn_time_s > kLongS &&
           track.velocity.norm() > kLeastMps;
  }
  // Her way as legs from now on.
  std::vector<Leg> roundOf(const traffic::Track& track, double until_s) const {
    constexpr double kLegS = 2.0;
    traffic::PredictionOptions prediction;
    prediction.horizon_s = now_s_ + until_s - track.stamp_s;
    const traffic::PredictedPath path(track, prediction);
    std::vector<Leg> legs;
    Eigen::Vector2d from = path.at(now_s_).position;
    for (double t = 0.0; t < until_s; t += kLegS) {
      const Eigen::Vector2d to = path.at(now_s_ + t + kLegS).position;
      legs.push_back({t, from, (to - from) / kLegS});
      from = to;
    }
    return legs;
  }

  // Where one is heard of others are soon. Who turns to port for the first, as is fair for one that
  // comes from abaft, may have to give way to the next by the other side: until then to starboard,
  // or slower, unless it presses.
  [[nodiscard]] bool listens() const {
    constexpr double kPressesS = 20.0;
    return hasJustHeardOfAll([](const Memory& /*memory*/, const Approach& approach) {
      return approach.time_s < kPressesS && approach.distance_m < kRiskM;
    });
  }

  // While a course is hardly known nearness far off is a guess, and acting for one who may do so
  // herself can't be undone.
  [[nodiscard]] bool mayHaveToStandOn() const {
    return hasJustHeardOfAll([&](const Memory& memory, const Approach& approach) {
      return approach.time_s < options_.stand_on_until_s ||
             !standsOn(classify(own_, memory.motion));
    });
  }

  // And `hurries` is true of none that comes nearer.
  template <typename Hurries>
  [[nodiscard]] bool hasJustHeardOfAll(const Hurries& hurries) const {
    constexpr double kListensS = 6.0;
    return std::all_of(memories_.begin(), memories_.end(), [&](const auto& known) {
      const Memory& memory = known.second;
      const Approach approach = nearestApproach(own_, memory.motion);
      return isLost(memory) || (now_s_ - memory.heard_s < kListensS &&
                                !(approach.time_s > 0.0 && hurries(memory, approach)));
    });
  }

  // Unseen for a while, she is nobody to decide about.
  [[nodiscard]] bool isLost(const Memory& memory) const {
    constexpr double kUnseenS = 5.0;
    return now_s_ - memory.seen_s > kUnseenS;
  }

  // A vessel that two others have passed close by may come out of it as another track: what was
  // between us and her goes on.
  std::map<int, Memory>::iterator lostAs(double now_s, const traffic::Track& track) {
    constexpr double kApartM = 10.0;
    constexpr double kApartMps = 0.7;
    const Motion motion = Motion{track.position, track.velocity}.after(now_s - track.stamp_s);
    auto nearest = memories_.end();
    double least = kApartM;
    for (auto it = memories_.begin(); it != memories_.end(); ++it) {
      const Memory& memory = it->second;
      if (it->first == track.id || memory.seen_s >= now_s) {
        continue;
      }
      const double apart =
          (memory.motion.after(now_s - memory.seen_s).position - motion.position).norm();
      if (apart < least && (memory.motion.velocity - motion.velocity).norm() < kApartMps) {
        nearest = it;
        least = apart;
      }
    }
    return nearest;
  }

  // The line's falls with the time it has been kept.
  static double velocityDeviation(const Memory& memory) {
    constexpr double kLineS = 4.0;
    constexpr double kLineMaxS = 20.0;
    const Eigen::Matrix4d& covariance = memory.track.covariance;
    return std::sqrt(0.5 * (covariance(2, 2) + covariance(3, 3))) * kLineS /
           std::clamp(memory.line.span(), kLineS, kLineMaxS);
  }

  // Whoever is first heard of was there before: a report of hers comes but every half minute, and
  // the first tell little of her course. So what we did meanwhile counts, against our course of
  // then.
  void recall(Memory& memory) const {
    for (const Past& then : past_) {
      follow(then, memory.motion.after(then.time_s - now_s_), memory);
    }
  }

  static void follow(const Past& now, const Motion& she, Memory& memory) {
    Record& record = memory.record;
    const Approach approach = nearestApproach(now.own, she);
    const double range = (she.position - now.own.position).norm();
    if (record.role == Role::kNone) {
      // Whoever may have to stand on does so before it is certain: acting early can't be undone.
      constexpr double kUnsureMaxM = 15.0;
      const double unsure =
          std::min(kUnsureMaxM, velocityDeviation(memory) * std::max(0.0, approach.time_s));
      const bool may_stand_on = approach.time_s > 0.0 && approach.time_s < kRiskS &&
                                approach.distance_m < kRiskM + unsure &&
                                standsOn(classify(now.own, she));
      if (now.own.velocity.norm() > 0.3 && (riskOfCollision(approach) || may_stand_on)) {
        record = Record();
        record.role = classify(now.own, she);
        record.kept_velocity = now.own.velocity;
        record.bearing_rad = bearing(now.own, she);
        memory.began_s = now.time_s;
        memory.followed_s = now.time_s;
        memory.aspect_rad = aspect(now.own, she);
      }
      return;
    }
    constexpr double kClearM = 40.0;
    // Slowing down behind her is not past and clear: would our course and speed of then be?
    const bool then_clear =
        nearestApproach({now.own.position, record.kept_velocity}, she).time_s < 0.0;
    if (approach.time_s < 0.0 && then_clear && range > kClearM) {
      record = Record();
      return;
    }
    const double dt = std::max(0.0, now.time_s - std::exchange(memory.followed_s, now.time_s));
    if (!now.under_way || approach.time_s < 0.0) {
      return;
    }
    const double speed = now.own.velocity.norm();
    const double share = speed / std::max(0.1, record.kept_velocity.norm());
    const double turn = speed > 0.3
                            ? -wrapAngle(now.own.course() - std::atan2(record.kept_velocity.y(),
                                                                       record.kept_velocity.x()))
                            : 0.0;
    const bool turns = std::abs(turn) > kActionRad;
    const bool acts = turns || std::abs(share - 1.0) > kActionShare;
    // What was kept is known the better the longer it has been: a way just begun winds a little.
    constexpr double kKnownS = 10.0;
    const double age = now.time_s - memory.began_s;
    if (standsOn(record.role) && !acts && !record.acted && age < kKnownS) {
      record.kept_velocity += dt / (kCourseS + age) * (now.own.velocity - record.kept_velocity);
    }
    memory.acts_since_s = !acts                           ? kNever
                          : memory.acts_since_s == kNever ? now.time_s
                                                          : memory.acts_since_s;
    // Waves push a course aside for moments.
    constexpr double kActionS = 1.0;
    if (acts && now.time_s - memory.acts_since_s >= kActionS - 1e-6) {
      record.acted = true;
      if (turns && record.first_turn == 0) {
        record.first_turn = turn > 0.0 ? 1 : -1;
      }
      record.slowed_first = record.slowed_first || (record.first_turn == 0 && share <= 0.5);
      record.turn_max_rad = std::max(record.turn_max_rad, std::abs(turn));
      record.slowest_share = std::min(record.slowest_share, share);
    }
  }

  // Straight on only as long as she has kept it up, and not over land.
  double knownFor(const Memory& memory, const map::DistanceField& field) const {
    constexpr double kLongS = 300.0;
    constexpr double kLeastS = 8.0;
    double known =
        memory.changed_s < 0.0 ? kLongS : std::max(kLeastS, 3.0 * (now_s_ - memory.changed_s));
    const double speed = memory.motion.velocity.norm();
    if (speed < 0.2 || !field.geometry().contains(memory.motion.position)) {
      return known;
    }
    const double land = 0.5 * memory.track.beam_m;
    double t = 0.0;
    while (t < known) {
      const Eigen::Vector2d p = memory.motion.after(t).position;
      if (!field.geometry().contains(p)) {
        break;
      }
      const double clear = field.clearance(p);
      if (clear < land && t > kLeastS) {
        return t;
      }
      t += std::max(2.0, clear - land) / speed;
    }
    return known;
  }

  // What plans can keep to in this weather, at most what they may.
  double cruiseOf(const Course& sailed) const {
    constexpr double kLeastMps = 0.5;
    double fastest = kLeastMps;
    for (const Leg& leg : sailed.legs) {
      fastest = std::max(fastest, leg.velocity.norm());
    }
    return std::min(cruise_mps_, fastest);
  }

  std::vector<Other> othersNow(const map::DistanceField& field) const {
    std::vector<Other> others;
    for (const auto& [id, memory] : memories_) {
      if (isLost(memory)) {
        continue;
      }
      const traffic::Track& track = memory.track;
      Other other;
      other.id = id;
      other.motion = memory.motion;
      other.length_m = track.length_m;
      other.beam_m = track.beam_m;
      other.heading_rad = track.heading_rad;
      other.position_deviation_m =
          std::sqrt(0.5 * (track.covariance(0, 0) + track.covariance(1, 1)));
      other.velocity_deviation_mps = velocityDeviation(memory);
      other.known_s = knownFor(memory, field);
      if (goesRound(track)) {
        constexpr double kRoundS = 20.0;
        other.known_s = kRoundS;
        other.round = roundOf(track, kRoundS);
      }
      other.record = memory.record;
      other.record.since_s = memory.began_s - now_s_;
      others.push_back(other);
    }
    return others;
  }

  // What a manoeuvre from there keeps to. What is sailed may be at its limits, whose acceleration
  // dies out beyond them, and those of what it leads to may be lower.
  feasibility::SafetyLimits limitsFrom(const Outset& outset, const vessel::FlatPoint& start,
                                       const trajectory::Trajectory& sailed, double at_s) const {
    constexpr double kTolerance = 1.015;
    feasibility::SafetyLimits limits = outset.limits;
    limits.clearance_m =
        std::min(limits.clearance_m, outset.obstacles.field().clearance(start.position) - 0.1);
    limits.speed_max_mps = kTolerance * std::max(limits.speed_max_mps, start.velocity.norm());
    const vessel::Thrusts sailed_n = sailed.sample(at_s, vessel_, limits.disturbance).thrusts;
    const double sailed_share = vessel::shareOfLimit(sailed_n, vessel_.thrusters);
    limits.thrust_share = std::max(limits.thrust_share, std::min(1.0, kTolerance * sailed_share));
    return limits;
  }

  // The choice as a trajectory that the hull can follow; nothing if it can't, or if that is not as
  // good as it looked.
  std::optional<Manoeuvre> realise(const Outset& outset, const Water& water, const Choice& choice,
                                   const std::vector<Other>& others, double keep) const {
    const trajectory::Trajectory& sailed = outset.sailed.trajectory;
    const double at = outset.sailed.elapsed(outset.joint_s);
    const Handling handling(vessel_, water.cruise_mps);
    const vessel::FlatPoint start = sailed.flat(at);
    const feasibility::SafetyLimits limits = limitsFrom(outset, start, sailed, at);
    Manoeuvre manoeuvre;
    for (const double slower : {1.0, 1.4, 2.0}) {
      Course course;
      if (choice.intent.alongThePath()) {
        const Eigen::Vector2d v = start.velocity;
        manoeuvre.path.trajectory = slowDown(
            sailed, at, choice.intent.share, choice.intent.hold_s,
            slower * handling.changeDuration(v, choice.intent.share * v), outset.begins_mps);
        manoeuvre.to_the_goal = true;
      } else {
        std::vector<Change> changes;
        const double zero = outset.joint_s - outset.now_s;  // the course's time of the joint
        const double begin = zero + choice.intent.wait_s;
        double end = 0.0;
        Eigen::Vector2d before = start.velocity;
        for (std::size_t k = 1; k <= choice.tail && k < choice.course.legs.size(); ++k) {
          const Leg& leg = choice.course.legs[k];
          if (leg.from_s <= begin + 1e-9) {
            continue;
          }
          Change change;
          change.duration_s = slower * handling.changeDuration(before, leg.velocity);
          change.at_s = std::max(leg.from_s - zero, 0.5 * change.duration_s);
          change.velocity = leg.velocity;
          end = std::max(end, change.at_s + 0.5 * change.duration_s);
          before = leg.velocity;
          changes.push_back(change);
        }
        constexpr double kSteadyS = 1.0;
        manoeuvre.path.trajectory = steer(start, changes, end + kSteadyS);
      }
      manoeuvre.path.start_time_s = outset.joint_s;
      if (manoeuvre.path.trajectory.empty()) {
        return std::nullopt;
      }
      const feasibility::Verification verification = feasibility::verify(
          manoeuvre.path.trajectory, outset.obstacles.startingAt(outset.joint_s), vessel_, limits);
      if (!verification.ok) {
        continue;
      }
      course = along(manoeuvre.path, outset.joint_s, outset.now_s);
      if (!manoeuvre.to_the_goal) {
        lead(course, choice, water);
      }
      constexpr double kStillBetterS = 3.0;
      if (chooser_.price(course, others, 1e9) + kStillBetterS < keep) {
        return manoeuvre;
      }
    }
    return std::nullopt;
  }

  // The rest of the way after a manoeuvre, as the choice has it.
  static void lead(Course& course, const Choice& choice, const Water& water) {
    Eigen::Vector2d from = course.legs.back().position +
                           (course.end_s - course.legs.back().from_s) * course.legs.back().velocity;
    double t = course.end_s;
    for (std::size_t k = choice.tail; k < choice.course.legs.size(); ++k) {
      const Leg& leg = choice.course.legs[k];
      const Eigen::Vector2d to =
          leg.position + (choice.course.endOf(k) - leg.from_s) * leg.velocity;
      const double distance = (to - from).norm();
      if (distance < 0.1) {
        continue;
      }
      course.legs.push_back({t, from, water.cruise_mps / distance * (to - from)});
      t += distance / water.cruise_mps;
      from = to;
    }
    course.end_s = t;
  }

  Options options_;
  vessel::Parameters vessel_;
  Chooser chooser_;
  std::map<int, Memory> memories_;
  std::deque<std::pair<double, Eigen::Vector2d>> trail_;
  Swing swing_;
  static constexpr double kPastS = 40.0;  // between two reports of a slow vessel, and some
  static constexpr double kPastStepS = 0.5;
  std::deque<Past> past_;
  Motion own_;
  double cruise_mps_ = 0.0;
  double now_s_ = 0.0;
  double goal_time_s_ = 0.0;
  double decided_s_ = -1e9;
  double act_by_s_ = kNever;  // when a course that was put off begins
  bool under_way_ = false;
};

Pilot::Pilot(const Options& options, const vessel::Parameters& vessel)
    : impl_(std::make_unique<Impl>(options, vessel)) {}
Pilot::~Pilot() = default;
Pilot::Pilot(Pilot&&) noexcept = default;
Pilot& Pilot::operator=(Pilot&&) noexcept = default;

void Pilot::newGoal(double now_s) {
  impl_->newGoal(now_s);
}
void Pilot::observe(double now_s, const Motion& own, const Eigen::Vector2d& steered,
                    const std::vector<traffic::Track>& tracks, const Eigen::Vector2d& goal,
                    double cruise_mps) {
  impl_->observe(now_s, own, steered, tracks, goal, cruise_mps);
}
std::optional<Manoeuvre> Pilot::decide(const Outset& outset) {
  return impl_->decide(outset);
}
std::vector<Encounter> Pilot::encounters() const {
  return impl_->encounters();
}

}  // namespace otter_nav::encounter
