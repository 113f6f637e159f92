#include "otter_nav/encounter/pilot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "encounter/candidates.hpp"
#include "encounter/lookout.hpp"
#include "encounter/manoeuvre.hpp"
#include "encounter/prospect.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::encounter {
namespace {

// A candidate must be better than what is being sailed by this, s: its polyline is only roughly
// what would be sailed, and tracks wander.
constexpr double kBetterS = 6.0;
constexpr double kPeriodS = 1.0;
constexpr double kNever = 1e18;

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
  if (const double braked = end - std::max(arrives, start); braked > 0.0) {
    constexpr double kLeastMps = 0.3;
    const vessel::FlatPoint from = sailed.trajectory.flat(end - braked);
    const double left_m = (sailed.trajectory.flat(end).position - from.position).norm();
    course.rests_s = std::max(0.0, braked - left_m / std::max(from.velocity.norm(), kLeastMps));
  }
  return course;
}

}  // namespace

class Pilot::Impl {
 public:
  Impl(const Options& options, const vessel::Parameters& vessel)
      : vessel_(vessel), lookout_(options), chooser_(options, vessel) {}

  void listen(double now_s) { lookout_.listen(now_s); }

  void newGoal(double now_s) {
    lookout_.newGoal(now_s);
    decided_s_ = -1e9;
    act_by_s_ = kNever;
  }

  void observe(double now_s, const Motion& own, const Eigen::Vector2d& steered,
               const std::vector<traffic::Track>& tracks, const Eigen::Vector2d& goal,
               double cruise_mps) {
    lookout_.observe(now_s, own, steered, tracks, goal, cruise_mps);
    chooser_.feel(lookout_.swing());
    cruise_mps_ = cruise_mps;
  }

  std::optional<Manoeuvre> decide(const Outset& outset) {
    if (lookout_.seesNobody() || outset.now_s - decided_s_ < kPeriodS) {
      return std::nullopt;
    }
    decided_s_ = outset.now_s;
    if (lookout_.mayHaveToStandOn() || lookout_.hasTimeToListen()) {
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
    const std::vector<Other> others = lookout_.others(water.field);
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
    const bool may_turn_to_port = !lookout_.listens();
    const auto choose = [&](bool may_wait) {
      return chooser_.choose(water, others, kTried, may_wait, may_turn_to_port);
    };
    const bool overdue = outset.now_s >= act_by_s_;
    std::vector<Choice> choices = choose(!overdue);
    if (overdue && !choices.empty() && chooser_.actsEarly(choices.front().course, others)) {
      // She is nearer later than it seemed when it was put off.
      choices = choose(true);
    }
    for (const Choice& choice : choices) {
      if (choice.price + kBetterS >= keep) {
        break;  // not worth it
      }
      if (choice.intent.wait_s > kPeriodS) {
        // Once put off it is not put off again, but for whom we still stand on: there would be
        // no end to it.
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

  std::vector<Encounter> encounters() const { return lookout_.encounters(); }

 private:
  // What plans can keep to in this weather, at most what they may.
  double cruiseOf(const Course& sailed) const {
    constexpr double kLeastMps = 0.5;
    double fastest = kLeastMps;
    for (const Leg& leg : sailed.legs) {
      fastest = std::max(fastest, leg.velocity.norm());
    }
    return std::min(cruise_mps_, fastest);
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
      const double price = chooser_.price(course, others, 1e9);
      if (price + kStillBetterS < keep) {
        manoeuvre.worth_s = keep - price + course.end_s - course.rests_s + water.sailed.rests_s;
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
    course.rests_s = 0.0;
  }

  vessel::Parameters vessel_;
  Lookout lookout_;
  Chooser chooser_;
  double cruise_mps_ = 0.0;
  double decided_s_ = -1e9;
  double act_by_s_ = kNever;  // when a course that was put off begins
};

Pilot::Pilot(const Options& options, const vessel::Parameters& vessel)
    : impl_(std::make_unique<Impl>(options, vessel)) {}
Pilot::~Pilot() = default;
Pilot::Pilot(Pilot&&) noexcept = default;
Pilot& Pilot::operator=(Pilot&&) noexcept = default;

void Pilot::listen(double now_s) {
  impl_->listen(now_s);
}
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
