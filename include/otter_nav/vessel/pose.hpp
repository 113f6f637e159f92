#pragma once

#include <Eigen/Core>

namespace otter_nav::vessel {

// A place with a heading: map frame, ENU, psi_rad counter-clockwise from east.
struct Pose {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // m
  double psi_rad = 0.0;
};

}  // namespace otter_nav::vessel
