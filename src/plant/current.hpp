// The water's mean motion, the same everywhere around the vessel and irrotational.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "gauss_markov.hpp"
#include "otter_nav/base/random.hpp"
#include "otter_nav/plant/options.hpp"

namespace otter_nav::plant {

class Current {
 public:
  Current(const CurrentOptions& options, std::uint64_t seed);
  void advance(double dt_s);
  [[nodiscard]] Eigen::Vector2d velocity() const;  // m/s, map frame

 private:
  CurrentOptions options_;
  Random random_;
  GaussMarkov slow_;
  double direction_rad_;
};

}  // namespace otter_nav::plant
