// A sensor of positions that sees far: other vessels round about, noisy, now and then missed, and
// now and then something that isn't there. Land and heights don't matter to it.
#pragma once

#include <cstdint>
#include <vector>

#include "otter_nav/base/random.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/plant/signals.hpp"

namespace otter_nav::plant {

class Radar {
 public:
  Radar(const RadarOptions& options, std::uint64_t seed) : options_(options), random_(seed) {}

  std::vector<Eigen::Vector2d> scan(const std::vector<OtherVessel>& others, const Truth& truth);

 private:
  RadarOptions options_;
  Random random_;
};

}  // namespace otter_nav::plant
