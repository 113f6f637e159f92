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
// Of crawling, before it counts: a launch in gusts sways as slowly as a swell.
constexpr double kSettlesS = 15.0;
// Faster turns make sway of their own.
constexpr double kTurnsRadps = 0.1;
constexpr double kLittleMps = 0.02;  // moves the usual frequency half way

}  // namespace

WaveFrequency::WaveFrequency()
    : mean_square_mps_(kLittleMps * kLittleMps),
      mean_square_m_(mean_square_mps_ / (kUsualRadps * kUsualRadps)),
      radps_(kUsualRadps) {}

void WaveFrequency::add(double sway_mps, double yaw_rate_radps, double crawling, double dt_s) {
  if (crawled_s_ == 0.0) {
    smooth_mps_ = steady_mps_ = sway_mps;
    aside_m_ = 0.0;
  }
  const auto follow = [&](double& value, double to, double time_s) {
    value += std::min(1.0, dt_s / time_s) * (to - value);
  };
  follow(smooth_mps_, sway_mps, kSmoothS);
  follow(steady_mps_, smooth_mps_, kSteadyS);
  const double to_and_fro_mps = smooth_mps_ - steady_mps_;
  aside_m_ += dt_s * (to_and_fro_mps - aside_m_ / kSteadyS);
  crawled_s_ = crawling < 0.5 ? 0.0 : crawled_s_ + dt_s;
  const double steady = std::max(0.0, 1.0 - std::abs(yaw_rate_radps) / kTurnsRadps);
  const double weight = crawling * steady;
  if (crawled_s_ < kSettlesS || weight <= 0.0) {
    return;
  }
  follow(mean_square_mps_, to_and_fro_mps * to_and_fro_mps, kSwellMemoryS / weight);
  follow(mean_square_m_, aside_m_ * aside_m_, kSwellMemoryS / weight);
  constexpr double kLittle = kLittleMps * kLittleMps;
  const double ratio =
      (mean_square_mps_ + kLittle) / (mean_square_m_ + kLittle / (kUsualRadps * kUsualRadps));
  // The position that follows takes 1 / kSteadyS^2 of it.
  radps_ = std::clamp(std::sqrt(std::max(0.0, ratio - 1.0 / (kSteadyS * kSteadyS))), kLeastRadps,
                      kMostRadps);
}

}  // namespace otter_nav::tracker
