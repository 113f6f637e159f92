// Randomness that is the same on every machine for a seed. The distributions of <random> differ
// between standard libraries, so the two the project needs are built on the raw engine.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "otter_nav/base/angles.hpp"

namespace otter_nav {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // Uniform in [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // Normal with mean 0 and variance 1 (Box and Muller).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * kPi * uniform());
  }
  std::uint64_t bits() { return engine_(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace otter_nav
