#include "otter_nav/plant/hull_contact.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/vessel/hull.hpp"
#include "rectangle.hpp"

namespace otter_nav::plant {
namespace {

// Visits the occupied cells of the square ring `k` cells around a cell.
template <typename Visit>
void visitRing(const WorldMap& world, const Eigen::Vector2i& centre, int k, const Visit& visit) {
  const auto side = [&](int length, const auto& cell_at) {
    int i = 0;
    while (i < length) {
      const Eigen::Vector2i cell = cell_at(i);
      const int free_cells = world.freeCells(cell.x(), cell.y());
      if (free_cells == 0) {
        visit(cell);
      }
      i += std::max(free_cells, 1);
    }
  };
  side(2 * k + 1, [&](int i) { return Eigen::Vector2i(centre + Eigen::Vector2i(i - k, -k)); });
  if (k == 0) {
    return;
  }
  side(2 * k + 1, [&](int i) { return Eigen::Vector2i(centre + Eigen::Vector2i(i - k, k)); });
  side(2 * k - 1, [&](int i) { return Eigen::Vector2i(centre + Eigen::Vector2i(-k, i + 1 - k)); });
  side(2 * k - 1, [&](int i) { return Eigen::Vector2i(centre + Eigen::Vector2i(k, i + 1 - k)); });
}

}  // namespace

double hullClearance(const WorldMap& world, const vessel::Hull& hull,
                     const Eigen::Vector2d& position, double psi_rad, double limit_m) {
  const map::GridGeometry& geometry = world.geometry();
  if (geometry.width == 0) {
    return limit_m;
  }
  const Rectangle rectangle(hull, position, psi_rad);
  const double radius = vessel::circumscribedRadius(hull);
  const Eigen::Vector2i centre = geometry.cellAt(position);
  const vessel::Hull square{geometry.resolution_m, geometry.resolution_m};
  double best = limit_m;
  const int first = geometry.contains(position) ? world.freeCells(centre.x(), centre.y()) : 0;
  for (int k = first; (k - 1) * geometry.resolution_m - radius < best && best > 0.0; ++k) {
    visitRing(world, centre, k, [&](const Eigen::Vector2i& cell) {
      best = std::min(
          best, rectangle.distance(Rectangle(square, geometry.centreOf(cell.x(), cell.y()), 0.0)));
    });
  }
  return best;
}

bool hullTouches(const WorldMap& world, const vessel::Hull& hull, const Eigen::Vector2d& position,
                 double psi_rad) {
  // Any limit will do that is not 0: cells farther away than it need no look.
  return hullClearance(world, hull, position, psi_rad, world.geometry().resolution_m) == 0.0;
}

}  // namespace otter_nav::plant
