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
// In waves the bow swings to and fro and turns back sooner than a straight line says. How quickly
// is learned once it has turned so often, and taken for slow (a period of 3 s) while it hardly
// swings.
constexpr double kSwingMemoryS = 5.0;
constexpr double kTurns = 3.0;
constexpr double kHardlyRad = 0.05;
constexpr double kSlowRadps = 2.0;
constexpr double kSwingMostRad = 0.5;  // a swing that ends beyond is none to rely on
constexpr double kSwingRad = 0.45;
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
    const double before_radps = rate_radps_;
    rate_radps_ += dt_s / (kRateFilterS + dt_s) * (rate - rate_radps_);
    learnSwing(now_rad, before_radps * rate_radps_ < 0.0, dt_s / kSwingMemoryS);
  } else {
    rate_radps_ = 0.0;
  }
  stamp_s_ = stamp_s;
  bow_up_rad_ = now_rad;
}

void BowGuard::learnSwing(double now_rad, bool turns, double share) {
  turns_ += (turns ? 1.0 : 0.0) - share * turns_;
  trim_rad_ += share * (now_rad - trim_rad_);
  const double swing_rad = now_rad - trim_rad_;
  swing_rad2_ += share * (swing_rad * swing_rad - swing_rad2_);
  rate_rad2ps2_ += share * (rate_radps_ * rate_radps_ - rate_rad2ps2_);
}

// As far as the bow goes on the way that `sign` says: straight on for a moment; or, if that is
// less, to the end of a swing with the angle and the rate of now, but as far as a half is cut at
// least, for a push ahead in each swing makes them higher. Where the end is high up the hull has
// left the water at one end, and turns back later than from other swings.
double BowGuard::soon(double sign) const {
  const double straight_rad = sign * (bow_up_rad_ + kLeadS * rate_radps_);
  if (turns_ < kTurns || sign * rate_radps_ <= 0.0) {
    return straight_rad;
  }
  constexpr double kHardlyRad2 = kHardlyRad * kHardlyRad;
  const double frequency_rad2ps2 =
      (rate_rad2ps2_ + kSlowRadps * kSlowRadps * kHardlyRad2) / (swing_rad2_ + kHardlyRad2);
  const double swing_rad = bow_up_rad_ - trim_rad_;
  const double end_rad =
      sign * trim_rad_ +
      std::sqrt(swing_rad * swing_rad + rate_radps_ * rate_radps_ / frequency_rad2ps2);
  return end_rad < kSwingMostRad ? std::min(straight_rad, std::max(end_rad, kSwingRad))
                                 : straight_rad;
}

vessel::Thrusts BowGuard::cut(const vessel::Thrusts& wanted,
                              const vessel::Thrusters& thrusters) const {
  const vessel::Thrusters& t = thrusters;
  const double mean_n = 0.5 * wanted.sum();
  // As far as the turn is kept.
  const double over_n = std::min(mean_n - mostPush(soon(1.0), t.ahead_max_n, t.astern_max_n),
                                 wanted.minCoeff() + t.astern_max_n);
  const double under_n = std::min(-mostPush(soon(-1.0), t.astern_max_n, t.ahead_max_n) - mean_n,
                                  t.ahead_max_n - wanted.maxCoeff());
  return wanted + (std::max(0.0, under_n) - std::max(0.0, over_n)) * vessel::Thrusts::Ones();
}

}  // namespace otter_nav::tracker
