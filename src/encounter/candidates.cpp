#include "encounter/candidates.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::encounter {
namespace {

std::size_t legAt(const Course& course, double t) {
  std::size_t k = 0;
  while (k + 1 < course.legs.size() && course.legs[k + 1].from_s <= t) {
    ++k;
  }
  return k;
}

Motion motionAt(const Course& course, double t) {
  const Leg& leg = course.legs[legAt(course, t)];
  return {leg.position + (t - leg.from_s) * leg.velocity, leg.velocity};
}

// The sailed way up to `wait`, then at `share` of its speed for `hold`, then as before, in changes
// that take `change_s`. False if it falls below `least_mps` by that for long.
bool slowed(const Course& sailed, double wait, double share, double hold, double change_s,
            double least_mps, Course& course) {
  course.legs.clear();
  double late = 0.0;  // what has been lost
  double below_s = 0.0;
  for (std::size_t k = 0; k < sailed.legs.size(); ++k) {
    const Leg& leg = sailed.legs[k];
    double t = leg.from_s;
    Eigen::Vector2d p = leg.position;
    const double end = sailed.endOf(k);
    while (t < end - 1e-9) {
      const double at = t + late;
      const bool before = at < wait - 1e-9;
      const bool within = !before && at < wait + hold - 1e-9;
      const double rate = within ? share : 1.0;
      const double until = before   ? wait
                           : within ? wait + hold
                                    : std::numeric_limits<double>::infinity();
      const double lasts = std::min((end - t) / rate, until - at);
      if (within && leg.from_s < sailed.arrives_s && fallsBelow(leg.velocity, rate, least_mps)) {
        below_s += lasts;
      }
      if (below_s > kBelowMostS) {
        return false;
      }
      course.legs.push_back({at, p, rate * leg.velocity, before ? 0.0 : change_s});
      p += rate * lasts * leg.velocity;
      t += rate * lasts;
      late += (1.0 - rate) * lasts;
    }
  }
  course.end_s = sailed.end_s + late;
  course.arrives_s = sailed.arrives_s + late;
  return true;
}

}  // namespace

bool Chooser::build(const Water& water, const Handling& handling, const Intent& intent,
                    Course& course, std::size_t& tail) const {
  const Course& sailed = water.sailed;
  tail = 0;
  const double begin = sailed.legs.front().from_s + intent.wait_s;
  if (intent.alongThePath()) {
    if (intent.share == 1.0 || intent.hold_s == 0.0) {
      course = sailed;
      return true;
    }
    const Eigen::Vector2d v = motionAt(sailed, begin).velocity;
    const double half = 0.5 * handling.changeDuration(v, intent.share * v);
    return slowed(sailed, begin + half, intent.share, half + intent.hold_s + half, 2.0 * half,
                  water.least_mps, course);
  }
  if (begin >= sailed.end_s - 1.0 || intent.share * water.cruise_mps < water.least_mps) {
    return false;
  }
  course.legs.clear();
  for (const Leg& leg : sailed.legs) {
    if (leg.from_s <= begin + 1e-9) {
      course.legs.push_back(leg);
    }
  }
  Motion at = motionAt(sailed, begin);
  if (at.velocity.norm() < 0.3) {
    return false;
  }
  double t = begin;
  double clearance = std::min(water.clearance_m, water.field.clearance(at.position) - 0.1);
  if (clearance <= 0.0) {
    return false;
  }
  // Of the way there: towards the farthest of its points in sight.
  const auto backToThePath = [&](const Eigen::Vector2d& from) {
    for (std::size_t i = water.path.size(); i-- > 0;) {
      if (map::segmentIsClear(water.field, from, water.path[i], clearance)) {
        return i;
      }
    }
    return water.path.size();
  };
  const std::size_t first = backToThePath(at.position);
  const Eigen::Vector2d towards =
      first < water.path.size() ? Eigen::Vector2d(water.path[first] - at.position) : at.velocity;
  const double length = towards.norm();
  if (length < 1.0) {
    return false;
  }
  const Eigen::Vector2d direction = towards / length;
  const auto sail = [&](const Eigen::Vector2d& velocity, double hold) {
    const double half = 0.5 * handling.changeDuration(at.velocity, velocity);
    const Eigen::Vector2d corner = at.position + half * at.velocity;
    const Eigen::Vector2d end = corner + (half + hold) * velocity;
    if (!map::segmentIsClear(water.field, at.position, corner, clearance) ||
        !map::segmentIsClear(water.field, corner, end, clearance)) {
      return false;
    }
    course.legs.push_back({t + half, corner, velocity, 2.0 * half});
    t += 2.0 * half + hold;
    at = {end, velocity};
    return true;
  };
  if (!sail(intent.share * water.cruise_mps * turned(direction, -intent.turn_rad), intent.hold_s)) {
    return false;
  }
  if (intent.then_s > 0.0 &&
      !sail(water.cruise_mps * turned(direction, -intent.then_turn_rad), intent.then_s)) {
    return false;
  }
  std::size_t next = backToThePath(at.position);
  if (next >= water.path.size()) {
    return false;
  }
  // The last turn leads to where the way is met from its corner.
  const Eigen::Vector2d off = water.path[next] - at.position;
  if (off.norm() < 1.0) {
    return false;
  }
  const double half =
      0.5 * handling.changeDuration(at.velocity, water.cruise_mps * off.normalized());
  const Eigen::Vector2d corner = at.position + half * at.velocity;
  tail = course.legs.size();
  double when = t + half;
  Eigen::Vector2d from = corner;
  for (; next < water.path.size(); ++next) {
    const Eigen::Vector2d leg = water.path[next] - from;
    const double distance = leg.norm();
    if (distance < 0.1) {
      continue;
    }
    course.legs.push_back({when, from, water.cruise_mps / distance * leg,
                           course.legs.size() == tail ? 2.0 * half : 0.0});
    when += distance / water.cruise_mps;
    from = water.path[next];
  }
  course.end_s = when;
  return tail < course.legs.size();
}

double Chooser::price(const Course& course, const std::vector<Other>& others,
                      double give_up_above) const {
  constexpr double kTurnS = 0.8;  // per radian: of two equal ways the straighter
  double turning = 0.0;
  for (std::size_t k = 1; k < course.legs.size() && k < 5; ++k) {
    const Eigen::Vector2d& a = course.legs[k - 1].velocity;
    const Eigen::Vector2d& b = course.legs[k].velocity;
    turning += std::abs(std::atan2(cross(a, b), a.dot(b)));
  }
  const double own = course.end_s - course.rests_s + kTurnS * turning;
  return own + prospect_.price(course, others, give_up_above - own);
}

bool Chooser::actsEarly(const Course& course, const std::vector<Other>& others) const {
  return std::any_of(others.begin(), others.end(), [&](const Other& other) {
    return (prospect_.look(course, other).broken & kActedEarly) != 0;
  });
}

std::vector<Choice> Chooser::choose(const Water& water, const std::vector<Other>& others,
                                    std::size_t count, bool may_wait, bool may_turn_to_port) const {
  constexpr double kTurnsDeg[] = {14.0, 24.0, 36.0, 48.0, 62.0, 80.0, 100.0, 130.0};
  const double slowest = std::max(0.2, water.least_mps / water.cruise_mps);
  const double shares[] = {1.0, 0.72, 0.45, slowest};
  constexpr double kHoldsS[] = {0.5, 3.0, 6.0, 10.0, 15.0, 22.0, 31.0, 43.0, 60.0, 85.0};
  constexpr double kThenS[] = {0.0, 8.0, 20.0, 40.0, 75.0};
  constexpr std::size_t kRefined = 5;
  constexpr int kRounds = 3;
  const Handling handling(vessel_, water.cruise_mps);

  std::vector<double> waits = {0.0, 8.0, 20.0, 40.0};
  for (const Other& other : others) {
    if (standsOn(other.record.role)) {
      const Motion own{water.sailed.legs.front().position, water.sailed.legs.front().velocity};
      const Approach left = nearestApproach(own, other.motion);
      waits.push_back(std::max(0.0, left.time_s - options_.stand_on_until_s));
      waits.push_back(std::max(0.0, left.time_s - options_.stand_on_until_s + 3.0));
      // Whoever comes up slowly is near before that.
      const double along = std::sqrt(
          std::max(0.0, std::pow(options_.stand_on_until_m, 2) - std::pow(left.distance_m, 2)));
      const double closing = std::max(0.1, (other.motion.velocity - own.velocity).norm());
      waits.push_back(std::max(0.0, left.time_s - along / closing + 1.0));
    }
  }
  std::sort(waits.begin(), waits.end());
  if (!may_wait) {
    waits = {0.0};
  }

  // Of two equal ones that which comes earlier, the more so where we have to give way.
  double waiting = 0.03;
  for (const Other& other : others) {
    if (givesWay(other.record.role) && !other.record.acted) {
      waiting = 0.2;
    }
  }
  std::vector<Choice> best;  // rising price
  Choice trial;
  const auto consider = [&](const Intent& intent) {
    if (intent.share < 1.0 && !may_turn_to_port &&
        prospect_.swingsAt(intent.share * water.cruise_mps)) {
      return;  // waves turn it to port
    }
    if (!build(water, handling, intent, trial.course, trial.tail)) {
      return;
    }
    const std::size_t keep = std::max(count, kRefined);
    const double bar = best.size() >= keep ? best.back().price : 1e9;
    trial.price = waiting * intent.wait_s;
    trial.price += price(trial.course, others, bar - trial.price);
    if (trial.price >= bar) {
      return;
    }
    trial.intent = intent;
    // One of a kind.
    const auto alike = [&](const Choice& other) {
      return std::abs(other.intent.wait_s - intent.wait_s) < 3.0 &&
             std::abs(other.intent.turn_rad - intent.turn_rad) < 0.3 &&
             std::abs(other.intent.share - intent.share) < 0.15;
    };
    const auto same = std::find_if(best.begin(), best.end(), alike);
    if (same != best.end()) {
      if (same->price <= trial.price) {
        return;
      }
      best.erase(same);
    }
    const auto place =
        std::upper_bound(best.begin(), best.end(), trial.price,
                         [](double value, const Choice& other) { return value < other.price; });
    best.insert(place, trial);
    if (best.size() > keep) {
      best.pop_back();
    }
  };
  consider({});
  for (const double wait : waits) {
    for (const double share : shares) {
      for (const double hold : kHoldsS) {
        if (share < 1.0) {
          consider({wait, 0.0, share, hold, 0.0, 0.0});
        }
        for (const double turn : kTurnsDeg) {
          if (share < 0.7 && turn < 30.0) {
            continue;
          }
          for (const double side : {1.0, -1.0}) {
            if (side < 0.0 && !may_turn_to_port) {
              break;
            }
            for (const double then : kThenS) {
              if (then > 0.0 && (share < 1.0 || turn > 90.0)) {
                break;
              }
              consider({wait, side * turn * kDegree, share, hold, then, 0.0});
            }
          }
        }
      }
    }
  }
  // The best, a step further in each of their figures.
  for (int round = 0; round < kRounds; ++round) {
    const double fine = std::pow(0.5, round);
    const std::vector<Choice> centres(
        best.begin(), best.begin() + static_cast<std::ptrdiff_t>(std::min(best.size(), kRefined)));
    for (const Choice& centre : centres) {
      const Intent& i = centre.intent;
      for (const double sign : {1.0, -1.0}) {
        const auto vary = [&](double Intent::*figure, double step, double least, double most) {
          Intent other = i;
          other.*figure = std::clamp(other.*figure + sign * step * fine, least, most);
          consider(other);
        };
        vary(&Intent::hold_s, 0.2 * i.hold_s + 1.0, 0.2, 150.0);
        if (i.wait_s > 0.0) {
          vary(&Intent::wait_s, 4.0, 0.0, 150.0);
        }
        if (i.share < 1.0) {
          vary(&Intent::share, 0.1, 0.15, 0.95);
        }
        if (!i.alongThePath()) {
          vary(&Intent::turn_rad, 8.0 * kDegree, may_turn_to_port ? -kPi : 0.0, kPi);
          if (i.share == 1.0) {
            vary(&Intent::then_s, 0.2 * i.then_s + 5.0, 0.0, 150.0);
          }
          if (i.then_s > 0.0) {
            vary(&Intent::then_turn_rad, 12.0 * kDegree, -kPi, kPi);
          }
        }
      }
    }
  }
  if (best.size() > count) {
    best.resize(count);
  }
  return best;
}

}  // namespace otter_nav::encounter
