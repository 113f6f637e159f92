#include "encounter/habits.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::encounter {
namespace {

constexpr double kEachS = 0.4;
constexpr double kGapS = 1.2;      // a longer one is no stretch of a way
constexpr double kKnownMps = 0.8;  // standard deviation of a velocity worth remembering
constexpr std::size_t kMostRecords = 20000;

// Who is taken to be on the same way.
constexpr double kSameWayM = 1.5;
constexpr double kCourseCosine = 0.87;  // 30 degrees: of who is hardly seen a course wanders
constexpr double kChangeShare = 0.3;
constexpr double kBeforeS = 3.0;
constexpr double kSameTrackM = 0.5;  // worth so much
constexpr double kLeastToldS = 2.0;  // of a way told

}  // namespace

void Habits::observe(const std::vector<traffic::Track>& tracks) {
  for (const traffic::Track& track : tracks) {
    const double deviation = std::sqrt(std::max(track.covariance(2, 2), track.covariance(3, 3)));
    if (!track.makesWay() || deviation > kKnownMps) {
      continue;
    }
    Record record{track.stamp_s, track.position, track.velocity, track.id};
    const auto last = last_.find(track.id);
    if (last != last_.end()) {
      const double since = track.stamp_s - records_[static_cast<std::size_t>(last->second)].time_s;
      if (since < kEachS) {
        continue;
      }
      if (since < kGapS) {
        records_[static_cast<std::size_t>(last->second)].next = static_cast<int>(records_.size());
        record.before = last->second;
      }
    }
    last_[track.id] = static_cast<int>(records_.size());
    records_.push_back(record);
  }
  if (records_.size() > kMostRecords) {
    forgetOldest();
  }
}

void Habits::forgetOldest() {
  const int cut = static_cast<int>(records_.size() / 2);
  records_.erase(records_.begin(), records_.begin() + cut);
  for (Record& record : records_) {
    record.before = std::max(-1, record.before - cut);
    record.next = record.next < 0 ? -1 : record.next - cut;
  }
  for (auto it = last_.begin(); it != last_.end();) {
    it->second -= cut;
    it = it->second < 0 ? last_.erase(it) : std::next(it);
  }
}

Habits::Match Habits::match(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity,
                            int id, double before_s) const {
  Match best;
  double least = kSameWayM;
  const double speed = velocity.norm();
  for (std::size_t k = 0; k < records_.size(); ++k) {
    const Record& record = records_[k];
    if (record.time_s > before_s || record.next < 0) {
      continue;
    }
    const Eigen::Vector2d off = position - record.position;
    if (off.squaredNorm() > 16.0) {
      continue;
    }
    const double then = record.velocity.norm();
    if (std::abs(then - speed) > kChangeShare * speed ||
        velocity.dot(record.velocity) < kCourseCosine * then * speed) {
      continue;
    }
    const Eigen::Vector2d stretch =
        records_[static_cast<std::size_t>(record.next)].position - record.position;
    const double length2 = std::max(1e-6, stretch.squaredNorm());
    const double share = off.dot(stretch) / length2;
    if (share < -0.1 || share > 1.1) {
      continue;
    }
    const double beside = (off - share * stretch).norm() + (record.id == id ? 0.0 : kSameTrackM);
    if (beside < least) {
      least = beside;
      best = {static_cast<int>(k), std::clamp(share, 0.0, 1.0)};
    }
  }
  return best;
}

std::optional<double> Habits::steadyTurn(const traffic::Track& track) const {
  constexpr double kHalfS = 1.2;
  constexpr double kLeastRadps = 0.04;
  constexpr double kAlike = 0.5;
  const auto last = last_.find(track.id);
  if (last == last_.end()) {
    return std::nullopt;
  }
  // Over two stretches, one before the other: who has turned a corner has turned in one alone.
  const Record* now = &records_[static_cast<std::size_t>(last->second)];
  const Record* at = now;
  double turned_rad = 0.0;
  double first_rad = 0.0;
  double first_s = 0.0;
  while (at->before >= 0 && now->time_s - at->time_s < 2.0 * kHalfS) {
    const Record* earlier = &records_[static_cast<std::size_t>(at->before)];
    turned_rad +=
        std::atan2(cross(earlier->velocity, at->velocity), earlier->velocity.dot(at->velocity));
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
  if (std::abs(mean) < kLeastRadps || late * early <= 0.0 ||
      std::abs(late - early) > kAlike * (std::abs(late) + std::abs(early))) {
    return std::nullopt;
  }
  return mean;
}

std::vector<Eigen::Vector2d> Habits::foretell(const traffic::Track& track, double from_s,
                                              double step_s, int steps) const {
  if (!track.makesWay()) {
    return {};
  }
  std::vector<Eigen::Vector2d> places;
  Eigen::Vector2d position = track.position + (from_s - track.stamp_s) * track.velocity;
  Eigen::Vector2d velocity = track.velocity;
  double told_s = 0.0;
  // Where a way breaks off another may lead on.
  constexpr int kWaysMost = 4;
  for (int ways = 0; ways < kWaysMost && static_cast<int>(places.size()) <= steps; ++ways) {
    const Match found = match(position, velocity, track.id, track.stamp_s - kBeforeS);
    if (found.record < 0) {
      break;
    }
    const Record* record = &records_[static_cast<std::size_t>(found.record)];
    const Record* next = &records_[static_cast<std::size_t>(record->next)];
    const double began = record->time_s + found.share * (next->time_s - record->time_s);
    const Eigen::Vector2d aside =
        position - (record->position + found.share * (next->position - record->position));
    const double first_s = told_s;
    for (;;) {
      const double t = static_cast<double>(places.size()) * step_s;
      if (static_cast<int>(places.size()) > steps) {
        break;
      }
      const double then = began + t - first_s;
      while (next != nullptr && then > next->time_s) {
        record = next;
        next = record->next < 0 ? nullptr : &records_[static_cast<std::size_t>(record->next)];
      }
      if (next == nullptr) {
        break;
      }
      const double share = (then - record->time_s) / (next->time_s - record->time_s);
      places.emplace_back(aside + record->position + share * (next->position - record->position));
      told_s = t;
    }
    if (next != nullptr) {
      break;
    }
    position = aside + record->position;
    velocity = record->velocity;
    told_s = first_s + record->time_s - began;
  }
  if (told_s < kLeastToldS) {
    return {};
  }
  while (static_cast<int>(places.size()) <= steps) {
    const double t = static_cast<double>(places.size()) * step_s;
    places.emplace_back(position + (t - told_s) * velocity);
  }
  return places;
}

}  // namespace otter_nav::encounter
