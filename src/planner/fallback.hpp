// What becomes of a tree's path without global optimisation: the paper's rows `baseline` and
// `+local`, made feasible by the least that will do, so that they can be sailed and compared.
#pragma once

#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "planner/obvp.hpp"

namespace otter_nav::planner {

// Where a tree is rooted at an end at rest: the state after a straight launch along `direction`,
// which is where the heading is defined (vessel/inverse_dynamics.hpp), and the launch itself.
struct Launch {
  KinoState root;
  trajectory::Piece piece;
};
// How fast it ends.
[[nodiscard]] double launchSpeed(const vessel::Parameters& vessel,
                                 const feasibility::SafetyLimits& limits);
[[nodiscard]] Launch launchFrom(const Eigen::Vector2d& position, const Eigen::Vector2d& direction,
                                double speed_mps);
// The same backwards in time: the state before a straight stop at `position`.
[[nodiscard]] Launch stopAt(const Eigen::Vector2d& position, const Eigen::Vector2d& direction,
                            double speed_mps);

// The tree's quintics, launch and stop included, as a trajectory that can be verified: spins at
// ends at rest to and from the path's own directions, the jerks at joints averaged (pieces of
// degree 7 through the same states), and, if it starts at rest, the whole slowed down until
// verification passes. An error gives verification's reason.
[[nodiscard]] Result<trajectory::Trajectory> closePath(const std::vector<trajectory::Piece>& path,
                                                       const trajectory::Boundary& start,
                                                       const trajectory::Boundary& goal,
                                                       const feasibility::Obstacles& obstacles,
                                                       const vessel::Parameters& vessel,
                                                       const feasibility::SafetyLimits& limits);

}  // namespace otter_nav::planner
