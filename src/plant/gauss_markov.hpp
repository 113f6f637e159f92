// Slowly varying noise with a given standard deviation and correlation time.
#pragma once

#include <cmath>

#include "otter_nav/base/random.hpp"

namespace otter_nav::plant {

// First-order Gauss-Markov (Ornstein-Uhlenbeck) process, sampled exactly for any step.
class GaussMarkov {
 public:
  GaussMarkov(double deviation, double time_s) : deviation_(deviation), time_s_(time_s) {}

  // Draws the first value from the stationary distribution.
  void start(Random& random) { value_ = deviation_ > 0.0 ? deviation_ * random.normal() : 0.0; }
  void advance(double dt_s, Random& random) {
    if (deviation_ > 0.0) {
      const double kept = std::exp(-dt_s / time_s_);
      value_ = kept * value_ + deviation_ * std::sqrt(1.0 - kept * kept) * random.normal();
    }
  }
  [[nodiscard]] double value() const { return value_; }

 private:
  double deviation_;
  double time_s_;
  double value_ = 0.0;
};

}  // namespace otter_nav::plant
