// Water with two islands, and planning that is the same on every machine.
#pragma once

#include "../../unit/planner/planner_ground.hpp"
#include "otter_nav/planner/planner.hpp"

namespace otter_nav::planner::test {

// Without a clock: bounded by iterations.
inline Termination byIterations() {
  Termination termination;
  termination.max_iterations = 2000;
  return termination;
}

inline map::DistanceField islands() {
  map::OccupancyGrid grid = openGrid();
  fill(grid, -12.0, -25.0, 6.0, 30.0);
  fill(grid, 8.0, -5.0, 5.0, 30.0);
  return map::DistanceField(grid, map::DistanceFieldOptions{});
}

}  // namespace otter_nav::planner::test
