#include "encounter/habits.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::encounter {
namespace {

constexpr double kEachS = 0.4;
constexpr double kGapS = 2.5;  // a longer one is no stretch of a way; the radar may miss her once
constexpr std::size_t kMostRecords = 20000;

// Who is taken to be on the same way.
constexpr double kSameWayM = 1.5;
constexpr double kCourseCosine = 0.87;  // 30 degrees: of who is hardly seen a course wanders
constexpr double kChangeShare = 0.3;
constexpr double kBeforeS = 3.0;
constexpr double kSameTrackM = 0.5;  // worth so much
constexpr double kAnotherPassS = 4.0;
constexpr double kStraysM = 0.25;    // from a way, who goes it again
constexpr double kLeastToldS = 2.0;  // of a way told

}  // namespace

void Habits::observe(const std::vector<traffic::Track>& tracks) {
  for (const traffic::Track& track : tracks) {
    if (track.makesWay()) {
      remember(track);
    }
  }
  for (const traffic::Track& track : tracks) {
    follow(track);
  }
  if (records_.size() > kMostRecords) {
    forgetOldest();
  }
  forgetWhoIsGone(tracks);
}

void Habits::remember(const traffic::Track& track) {
  Known& known = known_[track.id];
  const std::optional<GoesOn> now = known.motion.follow(track);
  if (!now) {
    return;
  }
  Record next{now->stamp_s, now->mean.head<2>(), now->mean.tail<2>(), track.id};
  next.tracked = now->mean;
  next.covariance = now->covariance;
  const double since_s = known.last < 0 ? kGapS : next.time_s - record(known.last).time_s;
  if (since_s < kEachS) {
    return;
  }
  if (!known.motion.wasLost() && since_s < kGapS) {
    records_[static_cast<std::size_t>(known.last)].next = static_cast<int>(records_.size());
    next.before = known.last;
  }
  known.last = static_cast<int>(records_.size());
  records_.push_back(next);
  smoothBefore(known.last);
}

// A track's number comes once: who is gone for a while comes back as another. Who is told of isn't
// gone, however long ago she was heard.
void Habits::forgetWhoIsGone(const std::vector<traffic::Track>& tracks) {
  constexpr double kGoneS = 30.0;
  double now_s = 0.0;
  for (const traffic::Track& track : tracks) {
    now_s = std::max(now_s, track.stamp_s);
  }
  for (const traffic::Track& track : tracks) {
    known_[track.id].told_s = now_s;
  }
  for (auto it = known_.begin(); it != known_.end();) {
    it = now_s - it->second.told_s > kGoneS ? known_.erase(it) : std::next(it);
  }
}

void Habits::forgetOldest() {
  const int cut = static_cast<int>(records_.size() / 2);
  records_.erase(records_.begin(), records_.begin() + cut);
  for (Record& record : records_) {
    record.before = std::max(-1, record.before - cut);
    record.next = record.next < 0 ? -1 : record.next - cut;
  }
  for (auto& [id, known] : known_) {
    known.last = std::max(-1, known.last - cut);
    known.place.at = {};
  }
}

// What came later tells better where she was and how she went: the smoother of Rauch, Tung and
// Striebel (1965) over the last records of a track, the velocity straying at random.
void Habits::smoothBefore(int last) {
  constexpr int kBack = 5;
  Eigen::Vector4d mean = record(last).tracked;
  int index = last;
  for (int k = 0; k < kBack && record(index).before >= 0; ++k) {
    const double dt = record(index).time_s - record(record(index).before).time_s;
    index = record(index).before;
    Record& then = records_[static_cast<std::size_t>(index)];
    const Straying straying(dt);
    const Eigen::Matrix4d foretold =
        straying.moves * then.covariance * straying.moves.transpose() + straying.adds;
    const Eigen::Matrix4d gain = then.covariance * straying.moves.transpose() * foretold.inverse();
    mean = then.tracked + gain * (mean - straying.moves * then.tracked);
    then.position = mean.head<2>();
    then.velocity = mean.tail<2>();
  }
}

bool Habits::moveAlong(Match& at, double by_s) const {
  double then = record(at.record).time_s +
                at.share * (record(record(at.record).next).time_s - record(at.record).time_s) +
                by_s;
  while (then < record(at.record).time_s && record(at.record).before >= 0) {
    at.record = record(at.record).before;
  }
  while (then > record(record(at.record).next).time_s) {
    at.record = record(at.record).next;
    if (record(at.record).next < 0) {
      return false;
    }
  }
  const double began = record(at.record).time_s;
  at.share = (then - began) / (record(record(at.record).next).time_s - began);
  return true;
}

void Habits::followBetterKnown(const traffic::Track& track, Place& place) const {
  constexpr double kWellKnownM2 = 0.25;
  constexpr double kEachSoOftenS = 0.4;
  if (variance(record(place.at.record)) < kWellKnownM2 ||
      track.stamp_s - place.sought_s < kEachSoOftenS) {
    return;
  }
  place.sought_s = track.stamp_s;
  const Match other = match(seen(track, track.stamp_s));
  if (other.record >= 0 && variance(record(other.record)) < kWellKnownM2) {
    place.at = other;
    place.off_s = 0.0;
  }
}

// Once on a way again she is so until she is off it for a moment: as she turns a corner there her
// course is known late.
void Habits::follow(const traffic::Track& track) {
  constexpr double kOffFarM = 4.0;
  constexpr double kOffM = 2.5;
  constexpr double kOffOnAnotherCourseM = 1.0;
  constexpr double kAnotherCourseCosine = 0.7;
  // Beside the way: of what is known well she is off sooner.
  constexpr double kWellBesideM = 0.3;
  constexpr double kWellBesideSigmas = 2.0;
  constexpr double kMayBeOffS = 0.4;
  constexpr double kLostS = 1.2;
  constexpr double kAlongS = 2.0;  // in which she is found to be earlier or later than before
  Place& place = known_[track.id].place;
  const double dt = track.stamp_s - place.stamp_s;
  place.stamp_s = track.stamp_s;
  if (!track.makesWay() || (place.at.record >= 0 && (dt > kLostS || !moveAlong(place.at, dt)))) {
    place.at.record = -1;
  }
  if (!track.makesWay()) {
    return;
  }
  const Seen she = seen(track, track.stamp_s);
  if (place.at.record < 0) {
    place.at = match(she);
    place.off_s = 0.0;
    return;
  }
  followBetterKnown(track, place);
  const Record& from = record(place.at.record);
  const Record& to = record(from.next);
  const Eigen::Vector2d stretch = to.position - from.position;
  const Eigen::Vector2d off = track.position - from.position - place.at.share * stretch;
  const bool another =
      track.velocity.dot(stretch) < kAnotherCourseCosine * track.velocity.norm() * stretch.norm();
  const double beside = std::abs(cross(stretch, off)) / std::max(1e-6, stretch.norm());
  const bool is_off =
      off.norm() > kOffM || (another && off.norm() > kOffOnAnotherCourseM) ||
      beside > kWellBesideM + kWellBesideSigmas * std::sqrt(variance(from) + she.variance_m2);
  place.off_s = is_off ? place.off_s + dt : 0.0;
  const Eigen::Vector2d velocity = stretch / (to.time_s - from.time_s);
  const double later_s =
      off.dot(velocity) / std::max(0.1, velocity.squaredNorm()) * (1.0 - std::exp(-dt / kAlongS));
  if (off.norm() > kOffFarM || place.off_s > kMayBeOffS || !moveAlong(place.at, later_s)) {
    place.at.record = -1;
  }
}

Habits::Seen Habits::seen(const traffic::Track& track, double at_s) {
  return {track.position + (at_s - track.stamp_s) * track.velocity, track.velocity,
          0.5 * (track.covariance(0, 0) + track.covariance(1, 1)), track.id,
          track.stamp_s - kBeforeS};
}

template <typename Visit>
void Habits::eachSameWay(const Seen& seen, const Visit& visit) const {
  constexpr double kStretchM = 6.0;  // from the one nearest to her, at most
  const double speed = seen.velocity.norm();
  for (std::size_t k = 0; k < records_.size(); ++k) {
    const Record& from = records_[k];
    if (from.time_s > seen.before_s || from.next < 0) {
      continue;
    }
    const Eigen::Vector2d off = seen.position - from.position;
    if (off.squaredNorm() > kStretchM * kStretchM) {
      continue;
    }
    const double then = from.velocity.norm();
    if (std::abs(then - speed) > kChangeShare * speed ||
        seen.velocity.dot(from.velocity) < kCourseCosine * then * speed) {
      continue;
    }
    const Eigen::Vector2d stretch = record(from.next).position - from.position;
    const double length2 = std::max(1e-6, stretch.squaredNorm());
    const double share = off.dot(stretch) / length2;
    if (share < -0.1 || share > 1.1) {
      continue;
    }
    const double beside = (off - share * stretch).norm();
    if (beside + (from.id == seen.id ? 0.0 : kSameTrackM) < kSameWayM) {
      visit(Match{static_cast<int>(k), std::clamp(share, 0.0, 1.0)}, beside);
    }
  }
}

// A way that the lidar has met is known better than the radar's, and who is on it is hardly beside
// it.
double Habits::unlikely(const Seen& seen, const Match& at, double beside_m) const {
  constexpr double kOfAnother = 0.7;  // half as likely
  const Record& there = record(at.record);
  const double spread2 = variance(there) + seen.variance_m2 + kStraysM * kStraysM;
  return 0.5 * (beside_m * beside_m / spread2 + std::log(spread2)) +
         (there.id == seen.id ? 0.0 : kOfAnother);
}

Habits::Match Habits::match(const Seen& seen) const {
  Match best;
  double least = std::numeric_limits<double>::infinity();
  eachSameWay(seen, [&](const Match& at, double beside_m) {
    const double now = unlikely(seen, at, beside_m);
    if (now < least) {
      least = now;
      best = at;
    }
  });
  return best;
}

std::vector<Habits::Pass> Habits::passesOf(const Seen& seen) const {
  std::vector<Pass> passes;
  std::map<int, std::size_t> latest;  // of each track
  eachSameWay(seen, [&](const Match& at, double beside_m) {
    const Record& there = record(at.record);
    const Pass now = {at, unlikely(seen, at, beside_m), there.time_s};
    const auto before = latest.find(there.id);
    if (before == latest.end() || there.time_s - passes[before->second].last_s >= kAnotherPassS) {
      latest[there.id] = passes.size();
      passes.push_back(now);
      return;
    }
    Pass& pass = passes[before->second];
    pass.last_s = there.time_s;
    if (now.unlikely < pass.unlikely) {
      pass = now;
    }
  });
  std::stable_sort(passes.begin(), passes.end(),
                   [](const Pass& a, const Pass& b) { return a.unlikely < b.unlikely; });
  return passes;
}

double Habits::varianceAhead(const Match& at) const {
  constexpr double kAheadS = 4.0;
  const double began = record(at.record).time_s;
  double all = 0.0;
  int count = 0;
  for (int k = at.record; k >= 0 && record(k).time_s - began < kAheadS; k = record(k).next) {
    all += variance(record(k));
    ++count;
  }
  return all / count;
}

void Habits::placesWithin(const Eigen::Vector2d& of, double range_m,
                          std::vector<Eigen::Vector2d>& places) const {
  for (const Record& record : records_) {
    if ((record.position - of).norm() < range_m) {
      places.push_back(record.position);
    }
  }
}

std::optional<double> Habits::steadyTurn(const traffic::Track& track) const {
  constexpr double kHalfS = 1.2;
  constexpr double kLeastRadps = 0.04;
  constexpr double kAlike = 0.5;
  constexpr double kAtOnce = 0.4;
  const auto known = known_.find(track.id);
  if (known == known_.end() || known->second.last < 0) {
    return std::nullopt;
  }
  // Over two stretches, one before the other: who has turned a corner has turned in one alone, or
  // most of it right between them.
  const Record* now = &record(known->second.last);
  const Record* at = now;
  double turned_rad = 0.0;
  double first_rad = 0.0;
  double first_s = 0.0;
  double most_rad = 0.0;  // in one stretch
  while (at->before >= 0 && now->time_s - at->time_s < 2.0 * kHalfS) {
    if (std::max(at->covariance(2, 2), at->covariance(3, 3)) > kKnownMps * kKnownMps) {
      return std::nullopt;
    }
    const Record* earlier = &records_[static_cast<std::size_t>(at->before)];
    // As tracked: smoothed, a corner looks like a round.
    const Eigen::Vector2d from = earlier->tracked.tail<2>();
    const Eigen::Vector2d to = at->tracked.tail<2>();
    const double turn_rad = std::atan2(cross(from, to), from.dot(to));
    most_rad = std::max(most_rad, std::abs(turn_rad));
    turned_rad += turn_rad;
    at = earlier;
    if (first_s == 0.0 && now->time_s - at->time_s >= kHalfS) {
      first_s = now->time_s - at->time_s;
      first_rad = turned_rad;
    }
  }
  const double all_s = now->time_s - at->time_s;
  if (all_s < 2.0 * kHalfS - 1e-6) {
    return std::nullopt;
  }
  const double late = first_rad / first_s;
  const double early = (turned_rad - first_rad) / (all_s - first_s);
  const double mean = turned_rad / all_s;
  if (std::abs(mean) < kLeastRadps || most_rad > kAtOnce * std::abs(turned_rad) ||
      late * early <= 0.0 || std::abs(late - early) > kAlike * (std::abs(late) + std::abs(early))) {
    return std::nullopt;
  }
  return mean;
}

std::vector<Eigen::Vector2d> Habits::foretell(const traffic::Track& track, double from_s,
                                              double step_s, int steps) const {
  std::vector<Way> all = ways(track, from_s, step_s, steps);
  return all.empty() ? std::vector<Eigen::Vector2d>{} : std::move(all.front().places);
}

std::vector<Way> Habits::ways(const traffic::Track& track, double from_s, double step_s,
                              int steps) const {
  constexpr std::size_t kMost = 9;
  constexpr double kFollowed = 2.0;  // times as likely: the one that she is on already
  if (!track.makesWay()) {
    return {};
  }
  const Seen now = seen(track, from_s);
  std::vector<Told> told;
  const auto take = [&](const Match& at, double likely) {
    Told next = tell(at, now, step_s, steps);
    if (!next.places.empty()) {
      next.likely = likely;
      told.push_back(std::move(next));
    }
  };
  Match followed;
  const auto known = known_.find(track.id);
  const Place place = known == known_.end() ? Place{} : known->second.place;
  const bool follows =
      place.at.record >= 0 && moveAlong(followed = place.at, from_s - place.stamp_s);
  if (follows) {
    followed.share = std::clamp(followed.share, 0.0, 1.0);
    take(followed, kFollowed);
  }
  const std::vector<Pass> passes = passesOf(now);
  for (const Pass& pass : passes) {
    const Record& there = record(pass.at.record);
    const bool same = follows && there.id == record(followed.record).id &&
                      std::abs(there.time_s - record(followed.record).time_s) < kAnotherPassS;
    if (!same && told.size() < kMost) {
      take(pass.at, std::exp(passes.front().unlikely - pass.unlikely));
    }
  }
  return partingWays(std::move(told));
}

Told Habits::tell(Match found, Seen seen, double step_s, int steps) const {
  constexpr int kWaysMost = 4;
  constexpr double kAsideS = 1.5;
  const Match first = found;
  std::vector<Eigen::Vector2d> places;
  double told_s = 0.0;
  for (int ways = 0; ways < kWaysMost && static_cast<int>(places.size()) <= steps; ++ways) {
    if (ways > 0) {
      found = match(seen);
    }
    if (found.record < 0) {
      break;
    }
    const Record* from = &record(found.record);
    const Record* next = &record(from->next);
    const double began = from->time_s + found.share * (next->time_s - from->time_s);
    const Eigen::Vector2d aside =
        seen.position - (from->position + found.share * (next->position - from->position));
    // Of what she is beside it as much as is an error, and not her straying.
    const double error2 = variance(*from) + seen.variance_m2;
    const double wrong = error2 / (error2 + kStraysM * kStraysM);
    const auto asideAfter = [&](double t) -> Eigen::Vector2d {
      return (1.0 - wrong * (1.0 - std::exp(-t / kAsideS))) * aside;
    };
    const double first_s = told_s;
    for (;;) {
      const double t = static_cast<double>(places.size()) * step_s;
      if (static_cast<int>(places.size()) > steps) {
        break;
      }
      const double then = began + t - first_s;
      while (next != nullptr && then > next->time_s) {
        from = next;
        next = from->next < 0 ? nullptr : &record(from->next);
      }
      if (next == nullptr) {
        break;
      }
      const double share = (then - from->time_s) / (next->time_s - from->time_s);
      places.emplace_back(asideAfter(t - first_s) + from->position +
                          share * (next->position - from->position));
      told_s = t;
    }
    if (next != nullptr) {
      break;
    }
    told_s = first_s + from->time_s - began;
    seen.position = asideAfter(told_s - first_s) + from->position;
    seen.velocity = from->velocity;
    seen.variance_m2 = variance(*from);
  }
  if (told_s < kLeastToldS) {
    return {};
  }
  Told told;
  told.variance_m2 = varianceAhead(first);
  told.known = places.size();
  while (static_cast<int>(places.size()) <= steps) {
    const double t = static_cast<double>(places.size()) * step_s;
    places.emplace_back(seen.position + (t - told_s) * seen.velocity);
  }
  told.places = std::move(places);
  return told;
}

}  // namespace otter_nav::encounter
