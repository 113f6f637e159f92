// What an attempt of the global optimiser is to reach; later attempts are more careful.
#pragma once

#include "optimizer/objective/cost.hpp"
#include "optimizer/solve/initial_spline.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/optimizer/ends.hpp"
#include "otter_nav/optimizer/global_optimizer.hpp"

namespace otter_nav::optimizer {

constexpr int kAttempts = 4;

struct Attempt {
  SplineLimits limits;
  SplineWeights weights;
  InitialOptions initial;
  EndOptions ends;
};

// The most that may be wanted of the force |w| by which a vessel turns, N: more would ask it to
// speed up all along.
[[nodiscard]] double mostHeadingForce(const vessel::Parameters& vessel,
                                      const feasibility::SafetyLimits& safety);

// Limits and weights are those of the spline, whose time runs slow by feasibility::speedShare.
// `number` counts from 0; `cell_m` is the map's resolution.
[[nodiscard]] Attempt attemptOf(int number, const GlobalOptions& options,
                                const vessel::Parameters& vessel,
                                const feasibility::SafetyLimits& safety, double cell_m);

}  // namespace otter_nav::optimizer
