#include "otter_nav/plant/hull_contact.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::plant {
namespace {

// Distance from a point to a box centred on the origin, in the box's axes.
double pointToBox(const Eigen::Vector2d& p, const Eigen::Vector2d& half) {
  return (p.cwiseAbs() - half).cwiseMax(0.0).norm();
}

// The hull's rectangle, ready to be measured against many squares.
class Rectangle {
 public:
  Rectangle(const vessel::Hull& hull, const Eigen::Vector2d& position, double psi_rad)
      : centre_(position),
        ahead_(std::cos(psi_rad), std::sin(psi_rad)),
        half_(0.5 * hull.length_m, 0.5 * hull.beam_m),
        corners_(vessel::outline(hull, position, psi_rad)) {}

  // Two convex shapes apart are nearest at a corner of one of them; shapes that overlap have no
  // separating axis among their sides' normals.
  [[nodiscard]] double distanceToSquare(const Eigen::Vector2d& square, double half) const {
    if (overlaps(square, half)) {
      return 0.0;
    }
    double distance = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& corner : corners_) {
      distance = std::min(distance, pointToBox(corner - square, Eigen::Vector2d::Constant(half)));
    }
    for (const double sx : {-half, half}) {
      for (const double sy : {-half, half}) {
        distance = std::min(distance,
                            pointToBox(inHull(square + Eigen::Vector2d(sx, sy) - centre_), half_));
      }
    }
    return distance;
  }

 private:
  [[nodiscard]] Eigen::Vector2d inHull(const Eigen::Vector2d& v) const {
    return {ahead_.dot(v), ahead_.x() * v.y() - ahead_.y() * v.x()};
  }
  [[nodiscard]] bool overlaps(const Eigen::Vector2d& square, double half) const {
    const Eigen::Vector2d between = square - centre_;
    const double c = std::abs(ahead_.x());
    const double s = std::abs(ahead_.y());
    const Eigen::Vector2d reach(c * half_.x() + s * half_.y(), s * half_.x() + c * half_.y());
    const Eigen::Vector2d seen = inHull(between).cwiseAbs();
    const double spread = half * (c + s);
    return std::abs(between.x()) <= reach.x() + half && std::abs(between.y()) <= reach.y() + half &&
           seen.x() <= half_.x() + spread && seen.y() <= half_.y() + spread;
  }

  Eigen::Vector2d centre_;
  Eigen::Vector2d ahead_;
  Eigen::Vector2d half_;
  std::array<Eigen::Vector2d, 4> corners_;
};

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
  const double half = 0.5 * geometry.resolution_m;
  double best = limit_m;
  const int first = geometry.contains(position) ? world.freeCells(centre.x(), centre.y()) : 0;
  for (int k = first; (k - 1) * geometry.resolution_m - radius < best && best > 0.0; ++k) {
    visitRing(world, centre, k, [&](const Eigen::Vector2i& cell) {
      best =
          std::min(best, rectangle.distanceToSquare(geometry.centreOf(cell.x(), cell.y()), half));
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
