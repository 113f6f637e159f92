// What ties a spline's blocks to each other and to its ends: pieces that last about as long as
// their neighbours, ends that move with their manoeuvres, and what does not move.
#pragma once

#include "optimizer/objective/spline_problem.hpp"

namespace otter_nav::optimizer {

// The couplings' cost; with `system`, whose blocks hold the pieces' model, their share of it, and
// the unknowns that are not free pinned to zero. To be called last.
double addCouplings(const Spline& spline, double time_weight, System* system);

}  // namespace otter_nav::optimizer
