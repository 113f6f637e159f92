#include "otter_nav/vessel/scripted_vessel.hpp"

#include <algorithm>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::vessel {

ScriptedMotion motionAt(const ScriptedVessel& vessel, double time_s) {
  double left_s = std::max(0.0, time_s);
  ScriptedMotion motion;
  motion.pose.position = vessel.waypoints.front();
  for (std::size_t leg = 0; leg + 1 < vessel.waypoints.size(); ++leg) {
    const Eigen::Vector2d along = vessel.waypoints[leg + 1] - vessel.waypoints[leg];
    const double length = along.norm();
    if (length <= 0.0) {
      continue;
    }
    motion.pose.psi_rad = angleOf(along);
    const double speed = vessel.speeds_mps[vessel.speeds_mps.size() == 1 ? 0 : leg];
    if (left_s * speed < length) {
      motion.pose.position = vessel.waypoints[leg] + left_s * speed / length * along;
      motion.speed_mps = speed;
      return motion;
    }
    left_s -= length / speed;
    motion.pose.position = vessel.waypoints[leg + 1];
  }
  return motion;
}

}  // namespace otter_nav::vessel
