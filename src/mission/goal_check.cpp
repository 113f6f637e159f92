#include "goal_check.hpp"

#include <cmath>

#include "otter_nav/base/text.hpp"

namespace otter_nav::mission {

Status checkGoal(const vessel::Pose& goal, const feasibility::Obstacles& obstacles,
                 double clearance_m) {
  const std::string what =
      text("goal (%.2f m, %.2f m, %.3f rad)", goal.position.x(), goal.position.y(), goal.psi_rad);
  if (!goal.position.allFinite() || !std::isfinite(goal.psi_rad)) {
    return failure(what + " is not finite");
  }
  const map::GridGeometry& map = obstacles.field().geometry();
  if (!map.contains(goal.position)) {
    const Eigen::Vector2d far =
        map.origin + map.resolution_m * Eigen::Vector2d(map.width, map.height);
    return failure(what + text(" is outside the map, x in [%.2f, %.2f], y in [%.2f, %.2f]",
                               map.origin.x(), far.x(), map.origin.y(), far.y()));
  }
  const double clearance = obstacles.field().clearance(goal.position);
  if (clearance <= 0.0) {
    return failure(what + " is inside an obstacle");
  }
  if (clearance < clearance_m) {
    return failure(what + text(" is %.2f m from an obstacle, at least %.2f m are needed", clearance,
                               clearance_m));
  }
  return {};
}

}  // namespace otter_nav::mission
