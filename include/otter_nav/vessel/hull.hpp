// The hull's outline in the plane: a rectangle of length by beam, centred on base_link.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "otter_nav/base/planar.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::vessel {

// Corners in the map frame, counter-clockwise from port bow.
inline std::array<Eigen::Vector2d, 4> outline(const Hull& hull, const Eigen::Vector2d& position,
                                              double psi_rad) {
  const Eigen::Vector2d ahead = unitVector(psi_rad);
  const Eigen::Vector2d half_length = 0.5 * hull.length_m * ahead;
  const Eigen::Vector2d half_beam = 0.5 * hull.beam_m * across(ahead);
  return {position + half_length + half_beam, position - half_length + half_beam,
          position - half_length - half_beam, position + half_length - half_beam};
}

// Whether a point lies within the hull's sides, all moved out by `margin_m`.
inline bool covers(const Hull& hull, const Pose& at, const Eigen::Vector2d& point,
                   double margin_m) {
  const Eigen::Vector2d local = Eigen::Rotation2Dd(-at.psi_rad) * (point - at.position);
  return std::abs(local.x()) <= 0.5 * hull.length_m + margin_m &&
         std::abs(local.y()) <= 0.5 * hull.beam_m + margin_m;
}

inline double circumscribedRadius(const Hull& hull) {
  return 0.5 * std::hypot(hull.length_m, hull.beam_m);
}

}  // namespace otter_nav::vessel
