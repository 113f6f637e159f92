// Out of the way of what wind and current drive a hull onto that has lost its heading. To turn it
// takes both thrusters full against each other, and meanwhile it is carried off; with the same
// thrust ahead or astern it would have passed beside. So thrusts in time are searched, by the
// motion that the manoeuvring model makes of them, and no heading has to be held on the way.
#pragma once

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::stopping {

// What discs that cover the hull leave to the nearest obstacle, m, at the least from `from_s` to
// `to_s`; negative where they touch, infinite where nothing is foreseen. Times of `foreseen` and
// obstacles are on one clock.
[[nodiscard]] double leastClearance(const vessel::Foreseen& foreseen, double from_s, double to_s,
                                    const feasibility::Obstacles& obstacles,
                                    const vessel::Hull& hull);

// What is foreseen, and from its end on, to `until_s`, the drift of its last two seconds. Faster
// than 1 m/s it is no drift: as it is.
[[nodiscard]] vessel::Foreseen driftingOn(vessel::Foreseen foreseen, double until_s);

struct Escape {
  // The model's own motion under its thrusts, in spins, from the state to where the hull has all
  // but come to rest, bow or stern to what pushes, and rest there within a second. It takes 7 s at
  // most before that; who has not come until then drifts still.
  trajectory::Trajectory path;
  double clearance_m = 0.0;  // of the discs at the least, on it and some seconds more
};

// The one that keeps clear best: two pairs of thrusts, full or none each, then turning into the
// load and braking. Where several are well clear, the one that is over first. Obstacles' times
// start with it.
[[nodiscard]] Escape escape(const vessel::State& state, const feasibility::Obstacles& obstacles,
                            const vessel::Parameters& vessel,
                            const vessel::Disturbance& disturbance);

}  // namespace otter_nav::stopping
