// What a decision is made on.
#pragma once

#include <Eigen/Core>
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

// Where the hull lies but for the waves that swing it abeam, which the tracker leaves it to at
// crawling pace. What begins at the end of a swing would be off by all of it half a wave later,
// and by half of it from its middle.
[[nodiscard]] vessel::State withoutSwing(const Moment& m);

}  // namespace otter_nav::mission
