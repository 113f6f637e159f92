// The hull's outline in the plane: a rectangle of length by beam, centred on base_link.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::vessel {

// Corners in the map frame, counter-clockwise from port bow.
inline std::array<Eigen::Vector2d, 4> outline(const Hull& hull, const Eigen::Vector2d& position,
                                              double psi_rad) {
  const Eigen::Vector2d ahead(std::cos(psi_rad), std::sin(psi_rad));
  const Eigen::Vector2d port(-ahead.y(), ahead.x());
  const Eigen::Vector2d half_length = 0.5 * hull.length_m * ahead;
  const Eigen::Vector2d half_beam = 0.5 * hull.beam_m * port;
  return {position + half_length + half_beam, position - half_length + half_beam,
          position - half_length - half_beam, position + half_length - half_beam};
}

inline double circumscribedRadius(const Hull& hull) {
  return 0.5 * std::hypot(hull.length_m, hull.beam_m);
}

}  // namespace otter_nav::vessel
