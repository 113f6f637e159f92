// The air's velocity over ground, the same everywhere around the vessel.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "gauss_markov.hpp"
#include "otter_nav/base/random.hpp"
#include "otter_nav/plant/options.hpp"

namespace otter_nav::plant {

class Wind {
 public:
  Wind(const WindOptions& options, std::uint64_t seed);
  void advance(double dt_s);
  [[nodiscard]] Eigen::Vector2d velocity() const;  // m/s, map frame

 private:
  WindOptions options_;
  Random random_;
  GaussMarkov slow_speed_;
  GaussMarkov slow_direction_;
  GaussMarkov gust_;
};

}  // namespace otter_nav::plant
