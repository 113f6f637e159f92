#include "tracker/wave_frequency.hpp"

#include <algorithm>
#include <cmath>

namespace otter_nav::tracker {
namespace {

constexpr double kUsualRadps = 2.0;
constexpr double kLeastRadps = 1.0;  // slower than that is what wind and current do
constexpr double kMostRadps = 4.0;   // faster waves are shorter than the hull, and move it little
// Shorter than the waves that matter, and longer.
constexpr double kSmoothS = 0.5;
constexpr double kSteadyS = 3.0;
constexpr double kSwellMemoryS = 20.0;
// Of crawling, before it counts: a launch in gusts sways as slowly as a swell. What is felt until
// then counts once it has turned out to be none, but for the first seconds, in which the means
// settle.
constexpr double kSettlesS = 15.0;
constexpr double kMeansSettleS = 6.0;
// Faster turns make sway of their own.
constexpr double kTurnsRadps = 0.2;
constexpr double kLittleMps = 0.02;  // moves the usual frequency half way
// Crawled for so long without more than this to and fro there are no waves that matter.
constexpr double kLooksS = 3.0;
constexpr double kCalmMps = 0.03;

}  // namespace

WaveFrequency::WaveFrequency() : radps_(kUsualRadps) {
  constexpr double kLittle = kLittleMps * kLittleMps;
  known_ = felt_ = {kLittle, kLittle / (kUsualRadps * kUsualRadps)};
}

void WaveFrequency::add(double sway_mps, double yaw_rate_radps, double crawling, double dt_s) {
  if (crawled_s_ == 0.0) {
    smooth_mps_ = steady_mps_ = sway_mps;
    aside_m_ = most_mps_ = 0.0;
    felt_ = known_;
  }
  const auto follow = [&](double& value, double to, double time_s) {
    value += std::min(1.0, dt_s / time_s) * (to - value);
  };
  crawled_s_ = crawling < 0.5 ? 0.0 : crawled_s_ + dt_s;
  follow(smooth_mps_, sway_mps, kSmoothS);
  // The mean at first: the sway that it begins with may be a crest's.
  follow(steady_mps_, smooth_mps_, std::clamp(crawled_s_, kSmoothS, kSteadyS));
  const double to_and_fro_mps = smooth_mps_ - steady_mps_;
  aside_m_ += dt_s * (to_and_fro_mps - aside_m_ / kSteadyS);
  most_mps_ = std::max(most_mps_, std::abs(to_and_fro_mps));
  const double steady = std::max(0.0, 1.0 - std::abs(yaw_rate_radps) / kTurnsRadps);
  const double weight = crawling * steady;
  if (crawled_s_ < kMeansSettleS || weight <= 0.0) {
    return;
  }
  follow(felt_.square_mps, to_and_fro_mps * to_and_fro_mps, kSwellMemoryS / weight);
  follow(felt_.square_m, aside_m_ * aside_m_, kSwellMemoryS / weight);
  if (crawled_s_ < kSettlesS) {
    return;
  }
  known_ = felt_;
  found_ = true;
  constexpr double kLittle = kLittleMps * kLittleMps;
  const double ratio =
      (known_.square_mps + kLittle) / (known_.square_m + kLittle / (kUsualRadps * kUsualRadps));
  // The position that follows takes 1 / kSteadyS^2 of it.
  radps_ = std::clamp(std::sqrt(std::max(0.0, ratio - 1.0 / (kSteadyS * kSteadyS))), kLeastRadps,
                      kMostRadps);
}

bool WaveFrequency::isKnown() const {
  return found_ || (crawled_s_ >= kLooksS && most_mps_ < kCalmMps);
}

}  // namespace otter_nav::tracker
