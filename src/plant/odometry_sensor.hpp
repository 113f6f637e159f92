// Odometry made from the truth: noisy and late as its options say.
#pragma once

#include <cstdint>
#include <deque>

#include "otter_nav/base/random.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/plant/signals.hpp"

namespace otter_nav::plant {

class OdometrySensor {
 public:
  OdometrySensor(const OdometryOptions& options, std::uint64_t seed);

  // Measures the truth at its stamp; stamps do not go back.
  void measure(const Truth& truth);
  // Forgets what was measured before.
  void reset() { pending_.clear(); }
  // The newest measurement that is latency_s old; the oldest one while none is.
  [[nodiscard]] const Odometry& latest() const { return latest_; }

 private:
  [[nodiscard]] Odometry withNoise(const Truth& truth);

  OdometryOptions options_;
  Random random_;
  std::deque<Odometry> pending_;
  Odometry latest_;
};

}  // namespace otter_nav::plant
