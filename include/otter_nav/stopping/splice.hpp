// What is left of a sailed trajectory, and how the next one continues it.
#pragma once

#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/flatness.hpp"
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

// The flat point of a vessel as it moves: velocity from the state, acceleration and jerk those of
// a steady surge force and yaw rate (inverse of vessel/flatness.hpp). The force keeps the speed, or
// is `force_max_n` where that takes more.
[[nodiscard]] vessel::FlatPoint flatFromState(const vessel::State& state,
                                              const vessel::PaperModel& model, double force_max_n);

}  // namespace otter_nav::stopping
