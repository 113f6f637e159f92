#include "encounter/prospect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::encounter {
namespace {

constexpr double kStandsMps = 0.15;
// More than the rules ask: what sailing along the polyline only roughly may lose.
constexpr double kTurnMoreRad = 0.05;
constexpr double kLaterS = 2.5;
constexpr double kNearerM = 1.5;
constexpr double kSlowShare = 0.48;
constexpr double kAtOnceS = 5.0;  // if the risk arises late, the action follows within this
constexpr double kBroadRad = 70.0 * kPi / 180.0;
// Her lane: to either side of her track; the outline of ours comes on top.
constexpr double kLaneM = 2.0;
constexpr double kLaneCrossingM = 75.0;
constexpr double kLaneOvertakingM = 20.0;
constexpr double kClearAfterM = 40.0;  // past and clear, once they draw apart

// At which share of the segment a-b it enters the box |x| <= half.x, |y| <= half.y, if it does.
std::optional<double> entersBox(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                const Eigen::Vector2d& half) {
  double from = 0.0;
  double to = 1.0;
  const Eigen::Vector2d d = b - a;
  bool outside = false;
  for (int k = 0; k < 2; ++k) {
    if (std::abs(d[k]) < 1e-12) {
      outside = outside || std::abs(a[k]) > half[k];
      continue;
    }
    const double u = (-half[k] - a[k]) / d[k];
    const double v = (half[k] - a[k]) / d[k];
    from = std::max(from, std::min(u, v));
    to = std::min(to, std::max(u, v));
  }
  return !outside && from <= to ? std::optional<double>(from) : std::nullopt;
}

// Distance of the segment a-b from that box.
double distanceToBox(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                     const Eigen::Vector2d& half) {
  if (entersBox(a, b, half)) {
    return 0.0;
  }
  const Eigen::Vector2d d = b - a;
  const auto ofPoint = [&](const Eigen::Vector2d& p) {
    return std::hypot(std::max(0.0, std::abs(p.x()) - half.x()),
                      std::max(0.0, std::abs(p.y()) - half.y()));
  };
  double least = std::min(ofPoint(a), ofPoint(b));
  const double length2 = d.squaredNorm();
  if (length2 > 1e-12) {
    for (const double x : {-half.x(), half.x()}) {
      for (const double y : {-half.y(), half.y()}) {
        const Eigen::Vector2d corner(x, y);
        const double share = std::clamp((corner - a).dot(d) / length2, 0.0, 1.0);
        least = std::min(least, (a + share * d - corner).norm());
      }
    }
  }
  return least;
}

// How long before the corner that stands for a change this is an action, s: the larger it is, the
// longer it takes, and the sooner after its beginning it shows.
double showsBefore(const Leg& leg, double turn_rad, double share) {
  // Of the whole duration, where a smooth step from 0 to 1 is at `part`; near its beginning.
  const auto reached = [](double part) { return 0.48 * std::sqrt(std::sqrt(part)); };
  const double turned = kActionRad / std::max(kActionRad, std::abs(turn_rad));
  const double slowed = kActionShare / std::max(kActionShare, std::abs(share - 1.0));
  return leg.change_s * (0.5 - reached(std::min(turned, slowed)));
}

double starboardTurn(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return -std::atan2(cross(from, to), from.dot(to));
}

}  // namespace

Outlook Prospect::look(const Course& own, const Other& other) const {
  Outlook out;
  out.outlines_m = std::numeric_limits<double>::infinity();
  const double her_speed = other.motion.velocity.norm();
  const double her_course = her_speed > kStandsMps ? other.motion.course() : other.heading_rad;
  const Eigen::Vector2d ahead = unitVector(her_course);
  const Eigen::Vector2d port = across(ahead);
  const auto inHerFrame = [&](const Eigen::Vector2d& v) {
    return Eigen::Vector2d(v.dot(ahead), v.dot(port));
  };
  const double end = std::min(own.end_s, other.known_s);
  const double half_length = 0.5 * hull_.length_m;
  const double half_beam = 0.5 * hull_.beam_m;

  // Distances first: what counts before the nearest approach is known then.
  double nearest2 = std::numeric_limits<double>::infinity();
  // While both keep their legs, hers with her bow to `bow`.
  const auto meet = [&](double from_s, double to_s, const Leg& leg, const Leg& she,
                        const Eigen::Vector2d& bow) {
    const double duration = to_s - from_s;
    const Eigen::Vector2d from = leg.position + (from_s - leg.from_s) * leg.velocity -
                                 she.position - (from_s - she.from_s) * she.velocity;
    const Eigen::Vector2d closing = leg.velocity - she.velocity;
    const double speed2 = closing.squaredNorm();
    const double at = speed2 > 1e-9 ? std::clamp(-from.dot(closing) / speed2, 0.0, duration) : 0.0;
    const double distance2 = (from + at * closing).squaredNorm();
    if (distance2 < nearest2) {
      nearest2 = distance2;
      out.nearest_s = from_s + at;
    }
    const double reach = 0.5 * (other.length_m + other.beam_m) + half_length + half_beam;
    if (std::sqrt(distance2) - reach < out.outlines_m) {
      const Eigen::Vector2d side = across(bow);
      const auto inFrame = [&](const Eigen::Vector2d& v) {
        return Eigen::Vector2d(v.dot(bow), v.dot(side));
      };
      const double speed = leg.velocity.norm();
      const double c = speed > kStandsMps ? std::abs(leg.velocity.dot(bow)) / speed : 1.0;
      const double s = speed > kStandsMps ? std::abs(leg.velocity.dot(side)) / speed : 1.0;
      const Eigen::Vector2d half(0.5 * other.length_m + half_length * c + half_beam * s,
                                 0.5 * other.beam_m + half_length * s + half_beam * c);
      out.outlines_m = std::min(
          out.outlines_m, distanceToBox(inFrame(from), inFrame(from + duration * closing), half));
    }
  };
  for (std::size_t k = 0; k < own.legs.size() && own.legs[k].from_s < end; ++k) {
    const Leg& leg = own.legs[k];
    const double until = std::min(own.endOf(k), end);
    if (other.round.empty()) {
      meet(leg.from_s, until, leg, {0.0, other.motion.position, other.motion.velocity}, ahead);
    }
    for (std::size_t j = 0; j < other.round.size(); ++j) {
      const Leg& she = other.round[j];
      const double from = std::max(leg.from_s, she.from_s);
      const double to =
          j + 1 < other.round.size() ? std::min(until, other.round[j + 1].from_s) : until;
      if (from < to) {
        meet(from, to, leg, she, she.velocity.normalized());
      }
    }
  }
  if (!options_.rules_of_the_road) {
    return out;
  }

  Record record = other.record;
  if (record.role == Role::kOvertaking || record.role == Role::kGiveWay ||
      record.role == Role::kHeadOn) {
    out.from_s = -std::numeric_limits<double>::infinity();
  }
  bool past = false;
  bool swings_first = false;
  // Gaining speed is no action: it counts once the speed kept was reached, or falls again.
  bool settling = record.role != Role::kNone && !record.acted;
  double speed_before = 0.0;
  Eigen::Vector2d before = own.legs.empty() ? Eigen::Vector2d(0.0, 0.0) : own.legs[0].velocity;
  const double decides = std::min(end, own.arrives_s);
  for (std::size_t k = 0; k < own.legs.size() && own.legs[k].from_s < decides && !past; ++k) {
    const Leg& leg = own.legs[k];
    const double to = std::min(own.endOf(k), end);
    const Motion she = other.motion.after(leg.from_s);
    if (record.role == Role::kNone) {
      // Each course that the turn sweeps over counts, then the leg's.
      constexpr double kSweepRad = 0.26;
      const double turn = -starboardTurn(before, leg.velocity);
      const int steps = before.norm() > kStandsMps && leg.velocity.norm() > kStandsMps
                            ? static_cast<int>(std::abs(turn) / kSweepRad)
                            : 0;
      for (int i = k == 0 ? steps + 1 : 1; i <= steps + 1 && record.role == Role::kNone; ++i) {
        const Motion we{leg.position,
                        i > steps ? leg.velocity : turned(before, turn * i / (steps + 1.0))};
        const Approach approach = nearestApproach(we, she);
        const double wait = i > steps ? std::max(0.0, approach.time_s - kRiskS + 1e-6) : 0.0;
        if (approach.time_s <= 0.0 || approach.distance_m >= kRiskM ||
            approach.time_s - wait >= kRiskS || leg.from_s + wait >= to) {
          continue;
        }
        const Motion we_then = we.after(wait);
        const Motion she_then = she.after(wait);
        record.role = classify(we_then, she_then);
        record.since_s = leg.from_s + wait;
        record.kept_velocity = we.velocity;
        record.bearing_rad = bearing(we_then, she_then);
        out.from_s = record.since_s;
      }
    }
    before = leg.velocity;
    if (record.role == Role::kNone) {
      continue;
    }
    const Eigen::Vector2d from = leg.position - she.position;
    const Eigen::Vector2d closing = leg.velocity - other.motion.velocity;
    const double kept_speed = record.kept_velocity.norm();
    const double share = leg.velocity.norm() / std::max(0.1, kept_speed);
    const double turn =
        leg.velocity.norm() > kStandsMps ? starboardTurn(record.kept_velocity, leg.velocity) : 0.0;
    const bool turns = std::abs(turn) > kActionRad;
    settling = settling && share < 1.0 - kActionShare && leg.velocity.norm() > speed_before - 0.02;
    speed_before = leg.velocity.norm();
    const bool slows = !settling && std::abs(share - 1.0) > kActionShare;
    // Nearest where it turns: that turn is an action, too, it began before.
    const bool before_nearest = leg.from_s <= out.nearest_s + 1e-6;
    if (before_nearest && (turns || slows) && leg.from_s >= record.since_s - 1e-6) {
      if (!record.acted) {
        record.acted = true;
        out.acted_s = leg.from_s;
        const Approach left = nearestApproach({leg.position, record.kept_velocity}, she);
        if (givesWay(record.role)) {
          const bool early = from.norm() >= options_.early_m + kEarlyMoreM ||
                             left.time_s >= options_.early_s + kEarlyMoreS ||
                             leg.from_s - record.since_s <= kAtOnceS;
          out.broken |= early ? 0U : kLate;
        } else {
          const double lead = std::min(leg.from_s, showsBefore(leg, turn, share));
          const Eigen::Vector2d began =
              from - lead * (record.kept_velocity - other.motion.velocity);
          const bool early = left.time_s + lead > options_.stand_on_until_s - kLaterS &&
                             began.norm() > options_.stand_on_until_m - kNearerM;
          out.broken |= early ? kActedEarly : 0U;
        }
      }
      if (turns && record.first_turn == 0) {
        record.first_turn = turn > 0.0 ? 1 : -1;
      }
      if (share <= kSlowShare && record.first_turn == 0) {
        record.slowed_first = true;
      }
      // Slower than that waves swing the course by what counts as a turn, to port as well; who has
      // turned to starboard before has shown what it means.
      const bool swings = swingsAt(leg.velocity.norm());
      swings_first = swings_first || (slows && swings && !turns && record.first_turn == 0);
      record.turn_max_rad = std::max(record.turn_max_rad, std::abs(turn));
      record.slowest_share =
          settling ? record.slowest_share : std::min(record.slowest_share, share);
      if (record.role == Role::kStandOn && turns && turn < 0.0) {
        out.broken |= kToPort;
      }
    }
    if (record.role == Role::kGiveWay || record.role == Role::kOvertaking) {
      const double ahead_m = record.role == Role::kGiveWay ? kLaneCrossingM : kLaneOvertakingM;
      const Eigen::Vector2d a = inHerFrame(from);
      const Eigen::Vector2d b = inHerFrame(from + (to - leg.from_s) * closing);
      const double reach_m = ahead_m + half_length + 0.5 * other.length_m;
      const Eigen::Vector2d middle(0.5 * reach_m, 0.0);
      const std::optional<double> enters =
          entersBox(a - middle, b - middle, {0.5 * reach_m, kLaneM + half_length});
      if (enters && (out.broken & kIntoHerLane) == 0) {
        out.broken |= kIntoHerLane;
        out.lane_s = leg.from_s + *enters * (to - leg.from_s);
      }
    }
    past = to > out.nearest_s && (from + (to - leg.from_s) * closing).norm() > kClearAfterM;
  }
  out.role = record.role;
  out.to_s = out.nearest_s;
  if (swings_first && record.role == Role::kStandOn) {
    out.broken |= kToPort;
  }
  if (out.role == Role::kNone || out.nearest_s <= 0.0) {
    return out;
  }
  // Who comes to rest at the goal, and to nobody near, gives way by that.
  const bool rests_clear = out.nearest_s >= std::min(own.arrives_s, own.end_s) - 1e-6 &&
                           std::sqrt(nearest2) > kClearAfterM;
  if (givesWay(record.role) && !rests_clear) {
    const bool turned_boldly = record.turn_max_rad >= options_.apparent_turn_rad + kTurnMoreRad;
    out.broken |= record.acted ? 0U : kLate;
    if (record.role != Role::kOvertaking && !turned_boldly && record.slowest_share > kSlowShare) {
      out.broken |= kNotApparent;
    }
    const bool to_starboard = record.first_turn >= 0;
    const bool narrow = std::abs(record.bearing_rad) < kBroadRad;
    if ((record.role == Role::kHeadOn && (record.first_turn != 1 || swings_first)) ||
        (record.role == Role::kGiveWay && narrow && (!to_starboard || swings_first) &&
         !record.slowed_first)) {
      out.broken |= kWrongTurn;
    }
    if (record.role == Role::kHeadOn) {
      // Port to port: we pass on her port side.
      std::size_t k = 0;
      while (k + 1 < own.legs.size() && own.legs[k + 1].from_s <= out.nearest_s) {
        ++k;
      }
      const Eigen::Vector2d us =
          own.legs[k].position + (out.nearest_s - own.legs[k].from_s) * own.legs[k].velocity;
      if ((us - other.motion.after(out.nearest_s).position).dot(port) < 0.0) {
        out.broken |= kWrongSide;
      }
    }
  }
  return out;
}

double Prospect::price(const Course& own, const std::vector<Other>& others,
                       double give_up_above) const {
  // In seconds: a rule broken, a metre too near, a near miss, a contact.
  constexpr double kRuleS = 60.0;
  constexpr double kNearS = 14.0;
  constexpr double kNearMissS = 30.0;
  constexpr double kTouchS = 150.0;
  constexpr double kContactS = 1000.0;
  constexpr double kMoreM = 1.3;  // for the outlines' ways beside the polyline
  constexpr double kUncertainMaxM = 4.0;
  // What is farther off counts less and less, and nothing in the end: there is time to decide.
  constexpr double kSoonS = 90.0;
  constexpr double kDistantS = 150.0;
  constexpr double kContactM = 0.8;
  // As risk arises its time is but an estimate, and there is time.
  constexpr double kUnsureS = 15.0;
  Outlook looks[kMostOthers];
  const std::size_t count = std::min(others.size(), kMostOthers);
  double price = 0.0;
  for (std::size_t j = 0; j < count && price <= give_up_above; ++j) {
    const Other& other = others[j];
    Outlook& look = looks[j];
    look = this->look(own, other);
    // Whoever stands on goes on watching her until she acts.
    const double watched_s = standsOn(look.role) ? std::max(0.0, look.acted_s) : 0.0;
    const double unwatched_s = std::max(0.0, look.nearest_s - watched_s);
    const double uncertain = std::min(
        kUncertainMaxM,
        std::hypot(other.position_deviation_m, other.velocity_deviation_mps * unwatched_s));
    const double wanted = options_.outline_wanted_m + kMoreM + uncertain;
    const double least = options_.outline_least_m + 0.5 * kMoreM;
    const double r = look.outlines_m;
    double near = 0.0;
    near += kNearS * std::max(0.0, wanted - r);
    near += kNearMissS * std::max(0.0, least - r);
    near += kTouchS * std::max(0.0, 3.0 - r);
    near += r < kContactM ? kContactS : 0.0;
    const auto counts = [&](double at_s) {
      return std::clamp((kDistantS - at_s) / (kDistantS - kSoonS), 0.0, 1.0);
    };
    price += near * counts(look.nearest_s);
    // Crossing, what we do is one action, now; after overtaking we come back into her lane later.
    const double lane = look.role == Role::kOvertaking ? counts(look.lane_s) : 1.0;
    price += (look.broken & kIntoHerLane) != 0 ? kRuleS * lane : 0.0;
    for (unsigned bits = look.broken & ~(kActedEarly | kToPort | kIntoHerLane); bits != 0;
         bits &= bits - 1) {
      price += kRuleS;
    }
  }
  // Whoever gives way to one need not stand on for another (rule 2), if there is no doubt about it.
  for (std::size_t j = 0; j < count && price <= give_up_above; ++j) {
    const unsigned standing = looks[j].broken & (kActedEarly | kToPort);
    if (standing == 0) {
      continue;
    }
    bool excused = false;
    for (std::size_t i = 0; i < count; ++i) {
      excused =
          excused || (givesWay(looks[i].role) && !others[i].record.doubtful &&
                      looks[i].from_s <= looks[j].acted_s && looks[j].acted_s <= looks[i].to_s &&
                      looks[i].to_s - looks[j].acted_s < kRiskS - kUnsureS);
    }
    if (!excused) {
      price += kRuleS * ((standing & kActedEarly) != 0 ? 1 : 0) +
               kRuleS * ((standing & kToPort) != 0 ? 1 : 0);
    }
  }
  return price;
}

}  // namespace otter_nav::encounter
