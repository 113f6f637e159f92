// Out of tight places: a vessel that stopped close to something can't turn without touching it, and
// none can plan from over the map's edge.
#pragma once

#include <optional>

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::stopping {

// How far a point lies inside the map's edge, m; negative outside.
[[nodiscard]] double insideMap(const map::GridGeometry& map, const Eigen::Vector2d& p);

// Room to turn on the spot: the hull's corners, and some more, m from its centre.
[[nodiscard]] double turningRoom(const vessel::Hull& hull);

// From rest at `state` to a place with more room, at best enough to turn on the spot: by legs
// straight astern or ahead with turns on the spot between them, the quickest; rest to rest.
// Verified like a plan, but for the clearance: the hull's exact outline keeps 0.1 m, or what the
// vessel is off its trajectory (`reach_m`), and what `disturbance` sets it aside during a leg; less
// where it begins with less. None where no better place is within four lengths.
[[nodiscard]] std::optional<trajectory::Trajectory> backOff(const vessel::State& state,
                                                            const feasibility::Obstacles& obstacles,
                                                            const vessel::Parameters& vessel,
                                                            const vessel::Disturbance& disturbance,
                                                            double reach_m = 0.0);

// From rest over the map's edge, or close to it, to the nearest place inside with room to turn: a
// turn on the spot towards or away from it, whichever is less, then straight; rest to rest. Nothing
// is known of the water outside; the edge itself stops nobody here. None without such a place near.
[[nodiscard]] std::optional<trajectory::Trajectory> turnBack(
    const vessel::State& state, const feasibility::Obstacles& obstacles,
    const vessel::Parameters& vessel);

// Whether the hull's outline touches nothing along the rest of such a manoeuvre, from `from_s` (s
// from its start) on.
[[nodiscard]] bool backOffIsClear(const trajectory::Trajectory& path, double from_s,
                                  const feasibility::Obstacles& obstacles,
                                  const vessel::Parameters& vessel);
[[nodiscard]] bool turnBackIsClear(const trajectory::Trajectory& path, double from_s,
                                   const feasibility::Obstacles& obstacles,
                                   const vessel::Parameters& vessel);

}  // namespace otter_nav::stopping
