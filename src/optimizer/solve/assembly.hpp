// A spline and the manoeuvres at its ends as one trajectory, and how much it asks for.
#pragma once

#include "optimizer/ends/path_ends.hpp"
#include "optimizer/objective/spline_problem.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/trajectory/trajectory.hpp"

namespace otter_nav::optimizer {

[[nodiscard]] trajectory::Trajectory assemble(const ChosenEnds& ends, const Spline& spline);

// The largest share by which a limit of thrust or speed is exceeded anywhere; negative: none is.
[[nodiscard]] double worstExcess(const trajectory::Trajectory& trajectory,
                                 const vessel::Parameters& vessel,
                                 const feasibility::SafetyLimits& safety);

// Lets time run slower by a factor, which leaves the shape as it is but for the second and last but
// one pieces: the outermost stay, as their ends are the manoeuvres'.
void dilate(double factor, Spline& spline);

}  // namespace otter_nav::optimizer
