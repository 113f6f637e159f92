// A state a trajectory begins or ends in.
#pragma once

#include "otter_nav/vessel/types.hpp"

namespace otter_nav::trajectory {

// At rest (`flat`'s derivatives zero) acceleration and jerk are the optimiser's to choose along the
// heading; moving, the heading follows from `flat`.
struct Boundary {
  vessel::FlatPoint flat;
  double psi_rad = 0.0;
};

[[nodiscard]] inline bool atRest(const Boundary& boundary) {
  return boundary.flat.velocity.norm() < 1e-3 && boundary.flat.acceleration.norm() < 1e-3 &&
         boundary.flat.jerk.norm() < 1e-3;
}

}  // namespace otter_nav::trajectory
