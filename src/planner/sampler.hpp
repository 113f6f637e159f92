// SampleState of the paper's algorithm 1: first the guide line's key states themselves, from both
// ends towards the middle, so that an easy way is found at once; then states drawn in the corridor
// around it, and a share from the whole map, so that a way the guide missed is found in the end.
#pragma once

#include "otter_nav/base/random.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "planner/guide_line.hpp"
#include "planner/obvp.hpp"

namespace otter_nav::planner {

struct SamplerOptions {
  double key_spacing_m = 9.0;  // between key states along the guide line
  double uniform_share = 0.1;  // of samples after the key states
  double accel_mps2 = 0.3;     // spread of accelerations, normal
  double speed_spread = 0.15;  // of the guide line's speed, normal
  double turn_spread_rad = 0.25;
  double speed_max_mps = 0.0;
};

class Sampler {
 public:
  Sampler(const SamplerOptions& options, const GuideLine& line, const map::DistanceField& field,
          std::uint64_t seed);

  [[nodiscard]] KinoState next();
  // As many of the first are the guide line's own.
  [[nodiscard]] int keyStates() const { return key_states_; }

 private:
  [[nodiscard]] KinoState keyState(int index) const;
  [[nodiscard]] KinoState inCorridor();
  [[nodiscard]] KinoState anywhere();

  SamplerOptions options_;
  const GuideLine* line_;
  const map::DistanceField* field_;
  Random random_;
  int key_states_ = 0;
  int drawn_ = 0;
};

}  // namespace otter_nav::planner
