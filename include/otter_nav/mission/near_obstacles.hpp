// What the tracker is told of the map: the outlines close to where it expects the hull.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::mission {

// Corners of occupied cells with open water beside them, map frame, that come within 0.6 m of the
// hull's outline now or where it is foreseen; the soonest first, and `most` at the most.
[[nodiscard]] std::vector<Eigen::Vector2d> nearObstacles(const map::DistanceField& field,
                                                         const vessel::Hull& hull,
                                                         const vessel::Pose& now,
                                                         const vessel::Foreseen& foreseen,
                                                         std::size_t most);

}  // namespace otter_nav::mission
