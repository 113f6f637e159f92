#include "otter_nav/mission/near_obstacles.hpp"

#include <cmath>
#include <set>
#include <utility>

#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::mission {
namespace {

// Of the outline: more than what is foreseen changes by until the next scan.
constexpr double kBesideHullM = 0.6;
// Of the foreseen way, or of what a turn moves the hull's ends by.
constexpr double kEachM = 0.3;

}  // namespace

std::vector<Eigen::Vector2d> nearObstacles(const map::DistanceField& field,
                                           const vessel::Hull& hull, const vessel::Pose& now,
                                           const vessel::Foreseen& foreseen, std::size_t most) {
  const map::GridGeometry& grid = field.geometry();
  const double reach_m = vessel::circumscribedRadius(hull) + kBesideHullM;
  std::vector<Eigen::Vector2d> points;
  std::set<std::pair<int, int>> told;
  const auto look = [&](const vessel::Pose& pose) {
    if (!pose.position.allFinite() || field.clearance(pose.position) >= reach_m) {
      return;
    }
    const map::CellRectangle cells = grid.around(pose.position, reach_m);
    for (int row = cells.row; row <= cells.row + cells.height; ++row) {
      for (int column = cells.column; column <= cells.column + cells.width; ++column) {
        const Eigen::Vector2d corner =
            grid.origin + grid.resolution_m * Eigen::Vector2d(column, row);
        if (points.size() < most && field.isOnOutline(column, row) &&
            vessel::covers(hull, pose, corner, kBesideHullM) && told.emplace(row, column).second) {
          points.push_back(corner);
        }
      }
    }
  };
  look(now);
  vessel::Pose last = now;
  for (const vessel::Pose& pose : foreseen.poses) {
    const double moved_m = (pose.position - last.position).norm() +
                           0.5 * hull.length_m * std::abs(pose.psi_rad - last.psi_rad);
    if (moved_m >= kEachM) {
      look(pose);
      last = pose;
    }
  }
  return points;
}

}  // namespace otter_nav::mission
