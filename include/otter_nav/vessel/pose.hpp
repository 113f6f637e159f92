#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace otter_nav::vessel {

// A place with a heading: map frame, ENU, psi_rad counter-clockwise from east.
struct Pose {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // m
  double psi_rad = 0.0;
};

// Where a vessel is expected to be, `step_s` apart; without poses nothing is known.
struct Foreseen {
  double start_s = 0.0;
  double step_s = 0.0;
  std::vector<Pose> poses;
};

// Points told from the pose, m ahead and to port, as places of the map.
[[nodiscard]] inline std::vector<Eigen::Vector2d> toMap(const Pose& pose,
                                                        std::vector<Eigen::Vector2d> points) {
  for (Eigen::Vector2d& point : points) {
    point = pose.position + Eigen::Rotation2Dd(pose.psi_rad) * point;
  }
  return points;
}

}  // namespace otter_nav::vessel
