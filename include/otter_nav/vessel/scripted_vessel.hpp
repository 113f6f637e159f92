// Another vessel that sails a route as it is written, whatever others do.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::vessel {

// A rectangle centred on its position. It heads along its leg, turns at once at a waypoint, and
// stops at the last one. Map frame, SI.
struct ScriptedVessel {
  int id = 0;
  Hull hull;
  bool ais = true;                         // broadcasts its position
  std::vector<Eigen::Vector2d> waypoints;  // two or more
  std::vector<double> speeds_mps;          // one, or one a leg; positive
};

struct ScriptedMotion {
  Pose pose;
  double speed_mps = 0.0;
};

// At `time_s` since the start; before it lies at the first waypoint's place, under way at once.
[[nodiscard]] ScriptedMotion motionAt(const ScriptedVessel& vessel, double time_s);

}  // namespace otter_nav::vessel
