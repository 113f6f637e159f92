#include "tracker/bow_guard.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::tracker {
namespace {

// Of where the bow will be: from the first on less is pushed ahead, from the second nothing, beyond
// it astern; of a bow that goes down the reverse. A hull on even keel doesn't get there: the
// Otter's bow comes up by 0.15 rad at most in the strongest sea that is shipped.
constexpr double kFreeRad = 0.3;
constexpr double kMostRad = 0.6;
// The hull's answer to less push takes about this long.
constexpr double kLeadS = 0.3;
// Of the rate's filter: what is measured is noisy.
constexpr double kRateFilterS = 0.05;
// After a gap, or a step back in time, the rate isn't known.
constexpr double kLongestStepS = 0.1;

// Of each thruster at most, one way, N, where that will have pitched the hull by `soon_rad`.
double mostPush(double soon_rad, double this_way_n, double other_way_n) {
  const double share = std::clamp((kMostRad - soon_rad) / (kMostRad - kFreeRad), -1.0, 1.0);
  return share * (share > 0.0 ? this_way_n : other_way_n);
}

}  // namespace

void BowGuard::add(double stamp_s, double bow_up_rad) {
  const double now_rad = std::isfinite(bow_up_rad) ? bow_up_rad : 0.0;
  const double dt_s = stamp_s - stamp_s_;
  if (dt_s == 0.0) {
    return;
  }
  if (dt_s > 0.0 && dt_s < kLongestStepS) {
    const double rate = (now_rad - bow_up_rad_) / dt_s;
    rate_radps_ += dt_s / (kRateFilterS + dt_s) * (rate - rate_radps_);
  } else {
    rate_radps_ = 0.0;
  }
  stamp_s_ = stamp_s;
  bow_up_rad_ = now_rad;
}

vessel::Thrusts BowGuard::cut(const vessel::Thrusts& wanted,
                              const vessel::Thrusters& thrusters) const {
  const double soon_rad = bow_up_rad_ + kLeadS * rate_radps_;
  const vessel::Thrusters& t = thrusters;
  const double mean_n = 0.5 * wanted.sum();
  // As far as the turn is kept.
  const double over_n = std::min(mean_n - mostPush(soon_rad, t.ahead_max_n, t.astern_max_n),
                                 wanted.minCoeff() + t.astern_max_n);
  const double under_n = std::min(-mostPush(-soon_rad, t.astern_max_n, t.ahead_max_n) - mean_n,
                                  t.ahead_max_n - wanted.maxCoeff());
  return wanted + (std::max(0.0, under_n) - std::max(0.0, over_n)) * vessel::Thrusts::Ones();
}

}  // namespace otter_nav::tracker
