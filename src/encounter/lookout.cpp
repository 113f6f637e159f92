#include "encounter/lookout.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::encounter {
namespace {

constexpr double kUnderWayS = 15.0;             // at most, until the cruising speed is reached
constexpr double kAlongRad = 0.5 * kActionRad;  // and the course that is steered to the goal
constexpr double kSteadiesS = 8.0;              // at least, until a course is kept
constexpr double kPastS = 40.0;                 // between two reports of a slow vessel, and some
constexpr double kPastStepS = 0.5;

// How near she comes while courses are kept, in the time that counts.
double comesWithin(const Motion& own, const Other& other) {
  if (other.record.role != Role::kNone) {
    return 0.0;  // a rule holds between us
  }
  const double t = std::clamp(nearestApproach(own, other.motion).time_s, 0.0, kRiskS);
  return (other.motion.after(t).position - own.after(t).position).norm();
}

// She turns, and has done so for a while.
bool goesRound(const traffic::Track& track) {
  constexpr double kTurnsRadps = 0.04;
  constexpr double kLongS = 20.0;
  constexpr double kLeastMps = 0.3;
  return std::abs(track.turn_rate_radps) > kTurnsRadps && track.turn_time_s > kLongS &&
         track.velocity.norm() > kLeastMps;
}

}  // namespace

void Lookout::listen(double now_s) {
  listens_since_s_ = std::min(listens_since_s_, now_s);
}

void Lookout::newGoal(double now_s) {
  past_.clear();
  goal_time_s_ = now_s;
  listen(now_s);
  under_way_ = false;
}

void Lookout::observe(double now_s, const Motion& own, const Eigen::Vector2d& steered,
                      const std::vector<traffic::Track>& tracks, const Eigen::Vector2d& goal,
                      double cruise_mps) {
  now_s_ = now_s;
  listen(now_s);
  remember(now_s, own, steered, goal, cruise_mps);
  swing_mps_ = swing_.seen(now_s, own.position - steered, own_.velocity);
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

bool Lookout::listens() const {
  constexpr double kPressesS = 20.0;
  return (awaitsReports() || hasJustHeardOfAll()) &&
         noneHurries([](const Memory& /*memory*/, const Approach& approach) {
           return approach.time_s < kPressesS && approach.distance_m < kRiskM;
         });
}

bool Lookout::mayHaveToStandOn() const {
  return hasJustHeardOfAll() && noneHurries([&](const Memory& memory, const Approach& approach) {
           return approach.time_s < options_.stand_on_until_s ||
                  !standsOn(classify(own_, memory.motion));
         });
}

bool Lookout::hasTimeToListen() const {
  constexpr double kUntilItShowsS = 12.0;  // a decision, and most of a turn
  return awaitsReports() && noneHurries([&](const Memory& memory, const Approach& approach) {
           const Eigen::Vector2d apart =
               memory.motion.after(kUntilItShowsS).position - own_.after(kUntilItShowsS).position;
           const double left_s = approach.time_s - kUntilItShowsS;
           return standsOn(memory.record.role) ? left_s < options_.stand_on_until_s
                                               : approach.distance_m < 2.0 * kRiskM &&
                                                     left_s < options_.early_s + kEarlyMoreS &&
                                                     apart.norm() < options_.early_m + kEarlyMoreM;
         });
}

std::vector<Other> Lookout::others(const map::DistanceField& field) const {
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
    other.position_deviation_m = std::sqrt(0.5 * (track.covariance(0, 0) + track.covariance(1, 1)));
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
  if (others.size() > kMostOthers) {
    std::vector<std::pair<double, std::size_t>> near;  // by how near they may come soon
    near.reserve(others.size());
    for (std::size_t k = 0; k < others.size(); ++k) {
      near.emplace_back(comesWithin(own_, others[k]), k);
    }
    std::sort(near.begin(), near.end());
    near.resize(kMostOthers);
    std::vector<Other> nearest;
    nearest.reserve(near.size());
    for (const auto& [distance_m, k] : near) {
      nearest.push_back(std::move(others[k]));
    }
    return nearest;
  }
  return others;
}

std::vector<Encounter> Lookout::encounters() const {
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

// Our own course as a mean; while getting under way, the course and speed we are about to have.
// As it is steered: that waves swing the hull is no action, and no course to be kept either.
void Lookout::remember(double now_s, const Motion& own, const Eigen::Vector2d& steered,
                       const Eigen::Vector2d& goal, double cruise_mps) {
  if (!trail_.empty() && now_s - trail_.back().first > kCourseS) {
    trail_.clear();
  }
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
  const bool cruises =
      own_.velocity.norm() > kCruising * cruise_mps && sails_s > kSteadiesS &&
      std::abs(wrapAngle(own_.course() - angleOf(goal - own.position))) < kAlongRad;
  under_way_ = under_way_ || cruises || sails_s > kUnderWayS;
  if (!under_way_ && (goal - own.position).norm() > 1.0) {
    own_.velocity = cruise_mps * (goal - own.position).normalized();
  }
}

void Lookout::see(double now_s, const traffic::Track& track) {
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

// Her way as legs from now on.
std::vector<Leg> Lookout::roundOf(const traffic::Track& track, double until_s) const {
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

// Small vessels report every half minute, and who is beyond the radar is heard of by that alone.
// Distances alone don't ask for it.
bool Lookout::awaitsReports() const {
  constexpr double kReportsS = 31.0;
  return options_.rules_of_the_road && now_s_ - listens_since_s_ <= kReportsS;
}

bool Lookout::hasJustHeardOfAll() const {
  constexpr double kJustS = 6.0;
  return std::all_of(memories_.begin(), memories_.end(), [&](const auto& known) {
    return isLost(known.second) || now_s_ - known.second.heard_s < kJustS;
  });
}

// `hurries` is true of none that comes nearer.
template <typename Hurries>
bool Lookout::noneHurries(const Hurries& hurries) const {
  return std::none_of(memories_.begin(), memories_.end(), [&](const auto& known) {
    const Approach approach = nearestApproach(own_, known.second.motion);
    return !isLost(known.second) && approach.time_s > 0.0 && hurries(known.second, approach);
  });
}

// Unseen for a while, she is nobody to decide about.
bool Lookout::isLost(const Memory& memory) const {
  constexpr double kUnseenS = 5.0;
  return now_s_ - memory.seen_s > kUnseenS;
}

// A vessel that two others have passed close by may come out of it as another track: what was
// between us and her goes on.
std::map<int, Lookout::Memory>::iterator Lookout::lostAs(double now_s,
                                                         const traffic::Track& track) {
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
double Lookout::velocityDeviation(const Memory& memory) {
  constexpr double kLineS = 4.0;
  constexpr double kLineMaxS = 20.0;
  const Eigen::Matrix4d& covariance = memory.track.covariance;
  return std::sqrt(0.5 * (covariance(2, 2) + covariance(3, 3))) * kLineS /
         std::clamp(memory.line.span(), kLineS, kLineMaxS);
}

// Whoever is first heard of was there before: a report of hers comes but every half minute, and
// the first tell little of her course. So what we did meanwhile counts, against our course of
// then.
void Lookout::recall(Memory& memory) const {
  for (const Past& then : past_) {
    follow(then, memory.motion.after(then.time_s - now_s_), memory);
  }
}

void Lookout::follow(const Past& now, const Motion& she, Memory& memory) {
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
  doubt(now, she, memory);
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

// While both keep course and speed, what comes out of it now came out of it when the risk seemed to
// arise: what was known of her then may have been wrong.
void Lookout::doubt(const Past& now, const Motion& she, Memory& memory) {
  constexpr double kKnownS = 10.0;
  constexpr double kKeptRad = 0.02;
  constexpr double kMoreM = 3.0;
  constexpr double kSigmas = 2.0;
  Record& record = memory.record;
  if (record.acted || !now.under_way || memory.line.span() < kKnownS ||
      memory.changed_s >= memory.began_s ||
      std::abs(wrapAngle(now.own.course() - angleOf(record.kept_velocity))) > kKeptRad) {
    return;
  }
  const Approach approach = nearestApproach(now.own, she);
  const double unsure_m = kSigmas * velocityDeviation(memory) * std::max(0.0, approach.time_s);
  record.doubtful = approach.distance_m > kRiskM + kMoreM + unsure_m;
}

// Straight on only as long as she has kept it up, and not over land.
double Lookout::knownFor(const Memory& memory, const map::DistanceField& field) const {
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

}  // namespace otter_nav::encounter
