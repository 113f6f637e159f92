// A rectangle with its axes at hand: how far it is from another, exactly.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::plant {

struct Rectangle {
  Eigen::Vector2d centre;
  Eigen::Vector2d ahead;
  Eigen::Vector2d half;
  std::array<Eigen::Vector2d, 4> corners;

  Rectangle(const vessel::Hull& hull, const Eigen::Vector2d& position, double psi_rad)
      : centre(position),
        ahead(unitVector(psi_rad)),
        half(0.5 * hull.length_m, 0.5 * hull.beam_m),
        corners(vessel::outline(hull, position, psi_rad)) {}

  // A vector seen from it.
  [[nodiscard]] Eigen::Vector2d local(const Eigen::Vector2d& v) const {
    return {ahead.dot(v), cross(ahead, v)};
  }
  // Convex shapes apart are nearest at a corner of one of them; rectangles that overlap have no
  // separating axis among their sides' normals.
  [[nodiscard]] double distance(const Rectangle& other) const {
    return separates(other) || other.separates(*this)
               ? std::min(toCorners(other), other.toCorners(*this))
               : 0.0;
  }

 private:
  // Whether one of its axes does.
  [[nodiscard]] bool separates(const Rectangle& other) const {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector2d high = -low;
    for (const Eigen::Vector2d& corner : other.corners) {
      const Eigen::Vector2d p = local(corner - centre);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    return (low.array() > half.array()).any() || (high.array() < -half.array()).any();
  }
  [[nodiscard]] double toCorners(const Rectangle& other) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector2d& corner : other.corners) {
      least = std::min(least, (local(corner - centre).cwiseAbs() - half).cwiseMax(0.0).norm());
    }
    return least;
  }
};

}  // namespace otter_nav::plant
