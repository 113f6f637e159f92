// Out of another vessel's way: one that lies still is run down by who doesn't see her.
#pragma once

#include <optional>

#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::stopping {

// Whether something comes over a vessel that lies at `position`, or so near that her hull could not
// turn there, within the next seconds.
[[nodiscard]] bool isRunDown(const Eigen::Vector2d& position,
                             const feasibility::Obstacles& obstacles, const vessel::Hull& hull);

// From rest at `state` straight ahead or astern, rest to rest, to where most room is left by all
// that comes; the heading stays, as there is no time to turn. Verified like a plan, but for the
// clearance: it touches nothing that lies still, and what moves passes farther off than it would.
// None where that can't be had.
[[nodiscard]] std::optional<trajectory::Trajectory> standAside(
    const vessel::State& state, const feasibility::Obstacles& obstacles,
    const vessel::Parameters& vessel);

}  // namespace otter_nav::stopping
