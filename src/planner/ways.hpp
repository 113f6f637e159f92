// What becomes of a tree's way without global optimisation: the paper's rows `baseline` and
// `+local`, made sound by the least that will do, so that they can be sailed and compared.
#pragma once

#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/planner/obvp.hpp"
#include "otter_nav/trajectory/trajectory.hpp"

namespace otter_nav::planner {

// sigma T + the integral of |jerk|^2 of the whole; spins count by their time.
[[nodiscard]] double trajectoryCost(const trajectory::Trajectory& trajectory, double sigma);

// Where a tree is rooted at an end at rest: the state after a straight launch along `direction`,
// which is where the heading is defined (vessel/inverse_dynamics.hpp), and the launch itself.
struct Launch {
  KinoState root;
  trajectory::Piece piece;
};
[[nodiscard]] Launch launchFrom(const Eigen::Vector2d& position, const Eigen::Vector2d& direction,
                                double top_speed_mps);
// The same backwards in time: the state before a straight stop at `position`.
[[nodiscard]] Launch stopAt(const Eigen::Vector2d& position, const Eigen::Vector2d& direction,
                            double top_speed_mps);

// The tree's quintics, launch and stop included, as a trajectory that can be verified: spins at
// ends at rest to and from the way's own directions, the jerks at joints averaged (pieces of
// degree 7 through the same states), and, if it starts at rest, the whole slowed down until
// verification passes. An error gives verification's reason.
[[nodiscard]] Result<trajectory::Trajectory> closeWay(const std::vector<trajectory::Piece>& way,
                                                      const trajectory::Boundary& start,
                                                      const trajectory::Boundary& goal,
                                                      const map::DistanceField& field,
                                                      const vessel::Parameters& vessel,
                                                      const feasibility::CheckOptions& check);

}  // namespace otter_nav::planner
