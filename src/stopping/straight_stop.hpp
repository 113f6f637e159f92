// A stop that leaves a curve first and brakes ahead in a line then.
#pragma once

#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::stopping {

struct StraightStop {
  double straighten_s = 1.0;  // the turn dies out within
  double brake_s = 2.0;       // and the speed within this after it
};

// From a flat point well under way. Course rate and speed follow polynomials in time that match
// the start, so that the yaw moment doesn't jump. Speed is kept until the way is straight: slowing
// down in a turn swings the hull, and that takes more moment than there is.
[[nodiscard]] trajectory::Trajectory straightStop(const vessel::FlatPoint& from,
                                                  const StraightStop& stop);

}  // namespace otter_nav::stopping
