// Out of a tight place: a vessel that stopped close to something can't turn without touching it.
#pragma once

#include <optional>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::stopping {

// Room to turn on the spot: the hull's corners, and some more, m from its centre.
[[nodiscard]] double turningRoom(const vessel::Hull& hull);

// From rest at `state` straight astern, or else ahead, with the heading kept, to the nearest place
// with room to turn; rest to rest. Verified like a plan, but for the clearance: the hull's
// outline keeps 0.1 m, and what `disturbance_n` could set it aside meanwhile. None if there is room
// already, or no such place within a few lengths.
[[nodiscard]] std::optional<trajectory::Trajectory> backOff(const vessel::State& state,
                                                            const map::DistanceField& field,
                                                            const vessel::Parameters& vessel,
                                                            double disturbance_n);

// The hull's outline keeps `least_m` along the rest of such a way, from `from_s` (s from its start)
// on; the heading is that at `from_s`.
[[nodiscard]] bool outlineKeepsClear(const trajectory::Trajectory& way, double from_s,
                                     const vessel::Parameters& vessel,
                                     const map::DistanceField& field, double least_m);

}  // namespace otter_nav::stopping
