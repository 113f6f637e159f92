// The hull's true outline against the world's cells, exactly.
#pragma once

#include <Eigen/Core>

#include "otter_nav/plant/world_map.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::plant {

// Distance, m, from the hull's rectangle at this pose to the nearest occupied cell (its whole
// square), 0 where they touch; `limit_m` if there is none nearer.
[[nodiscard]] double hullClearance(const WorldMap& world, const vessel::Hull& hull,
                                   const Eigen::Vector2d& position, double psi_rad, double limit_m);

// Whether they touch: the same answer as a clearance of 0, sooner.
[[nodiscard]] bool hullTouches(const WorldMap& world, const vessel::Hull& hull,
                               const Eigen::Vector2d& position, double psi_rad);

}  // namespace otter_nav::plant
