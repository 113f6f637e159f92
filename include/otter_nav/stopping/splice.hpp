// What is left of a sailed trajectory, and how the next one continues it.
#pragma once

#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::stopping {

// The sailed trajectory up to `at_s`, then `next`, from the piece on that `from_s` lies in.
// `start_s` of the result: when it begins on the sailed trajectory's time.
struct Spliced {
  trajectory::Trajectory trajectory;
  double start_s = 0.0;
};
[[nodiscard]] Spliced splice(const trajectory::Trajectory& sailed, double from_s, double at_s,
                             const trajectory::Trajectory& next);

// What is left of a trajectory from `at_s` on, exactly.
[[nodiscard]] trajectory::Trajectory remainder(const trajectory::Trajectory& trajectory,
                                               double at_s);

}  // namespace otter_nav::stopping
