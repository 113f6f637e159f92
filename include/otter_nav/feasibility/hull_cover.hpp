// The hull among obstacles. Every check of a path sees it as the same discs: three, and near
// obstacles seven smaller ones. Where a place is too tight for these, its outline is looked at
// itself.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::feasibility {

// Three discs of `radius_m` that cover the hull's rectangle: at its centre and `offset_m` ahead and
// astern of it. And seven that stand out less: three of `middle_m` on the middle line, a fifth of
// the length apart, and at each corner one of `corner_m`.
struct HullCover {
  double offset_m = 0.0;
  double radius_m = 0.0;
  double middle_m = 0.0;
  double corner_m = 0.0;
  Eigen::Vector2d corner;  // ahead and to port of the hull's centre, m

  // `margin_m` wider all round.
  explicit HullCover(const vessel::Hull& hull, double margin_m = 0.0)
      : offset_m(hull.length_m / 3.0),
        radius_m(std::hypot(hull.length_m / 6.0, hull.beam_m / 2.0) + margin_m),
        middle_m(std::hypot(hull.length_m / 10.0, hull.beam_m / 2.0) + margin_m),
        corner_m(std::hypot(hull.length_m / 10.0, hull.beam_m / 4.0) + margin_m),
        corner(0.4 * hull.length_m, 0.25 * hull.beam_m) {}

  // Of the circle around the three.
  [[nodiscard]] double reach() const { return offset_m + radius_m; }
  // How far from the hull's centre a disc's is at most: what turning moves.
  [[nodiscard]] double arm() const { return std::max(offset_m, corner.norm()); }

  // How far the hull at `position` may still move before its centre is nearer than
  // `centre_clearance_m` or its discs touch anything, m; negative where that is so already. Far
  // from everything a lower bound. `bow` gives the unit vector ahead, and is asked near obstacles
  // only. `centre` gets the clearance of the hull's centre.
  template <typename Bow>
  [[nodiscard]] double slack(const Obstacles& obstacles, const Eigen::Vector2d& position,
                             double time_s, double centre_clearance_m, const Bow& bow,
                             double& centre_m) const {
    constexpr double kRoomyM = 0.1;
    centre_m = obstacles.clearance(position, time_s);
    const double left = centre_m - centre_clearance_m;
    const double around = centre_m - reach();
    if (left <= 0.0 || around >= 0.5 * left) {
      return std::min(left, around);
    }
    const Eigen::Vector2d ahead = bow();
    const auto near = [&](const Eigen::Vector2d& p) { return obstacles.clearance(p, time_s); };
    const Eigen::Vector2d end = offset_m * ahead;
    const double ends = std::min(near(position + end), near(position - end));
    const double three = std::min(ends, centre_m) - radius_m;
    return std::min(left, three >= kRoomyM ? three : sevenClear(position, ahead, centre_m, near));
  }

 private:
  template <typename Near>
  [[nodiscard]] double sevenClear(const Eigen::Vector2d& position, const Eigen::Vector2d& ahead,
                                  double centre_m, const Near& near) const {
    const Eigen::Vector2d port = corner.y() * across(ahead);
    double least = centre_m - middle_m;
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector2d end = position + side * corner.x() * ahead;
      least = std::min({least, near(position + 0.5 * side * corner.x() * ahead) - middle_m,
                        near(end + port) - corner_m, near(end - port) - corner_m});
    }
    return least;
  }
};

// The least `clearance(point)` along the rectangle's outline, looked at every few centimetres.
template <typename Clearance>
[[nodiscard]] double outlineClearance(const vessel::Hull& hull, const Eigen::Vector2d& position,
                                      double psi_rad, const Clearance& clearance) {
  constexpr int kSteps = 20;
  const Eigen::Vector2d ahead = unitVector(psi_rad);
  const Eigen::Vector2d port = across(ahead);
  double least = std::numeric_limits<double>::infinity();
  for (int k = -kSteps; k <= kSteps; ++k) {
    const Eigen::Vector2d along = 0.5 * hull.length_m * k / kSteps * ahead;
    const Eigen::Vector2d across = 0.5 * hull.beam_m * k / kSteps * port;
    for (const double side : {-0.5, 0.5}) {
      least = std::min({least, clearance(position + along + side * hull.beam_m * port),
                        clearance(position + across + side * hull.length_m * ahead)});
    }
  }
  return least;
}

}  // namespace otter_nav::feasibility
