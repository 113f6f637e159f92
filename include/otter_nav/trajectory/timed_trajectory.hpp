#pragma once

#include <limits>

#include "otter_nav/trajectory/trajectory.hpp"

namespace otter_nav::trajectory {

// To be sailed as if begun at `start_time_s` on the caller's clock.
struct TimedTrajectory {
  Trajectory trajectory;
  double start_time_s = 0.0;
  // What it was planned for, over ground; where the trajectory itself is faster, that counts.
  double speed_max_mps = std::numeric_limits<double>::infinity();
  // A motion of the vessel's model under thrusts that were chosen: its headings are meant as they
  // are, also where the wind would have others.
  bool rolled_out = false;

  [[nodiscard]] double elapsed(double now_s) const { return now_s - start_time_s; }
  [[nodiscard]] double left(double now_s) const { return trajectory.duration() - elapsed(now_s); }
};

}  // namespace otter_nav::trajectory
