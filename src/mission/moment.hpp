// What a decision is made on.
#pragma once

#include <cmath>

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/mission/supervisor.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::mission {

struct Moment {
  double now_s;
  const Situation& situation;
  const feasibility::Obstacles& obstacles;
};

// As far as waves leave it.
[[nodiscard]] inline bool atRest(const vessel::State& state) {
  constexpr double kAtRestMps = 0.2;
  constexpr double kAtRestRadps = 0.1;
  return vessel::speedOf(state) < kAtRestMps && std::abs(state[vessel::kYawRate]) < kAtRestRadps;
}

}  // namespace otter_nav::mission
