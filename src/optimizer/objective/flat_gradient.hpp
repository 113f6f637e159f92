// The flatness map (vessel/flatness.hpp, still water, bow along w) with its derivatives, for an
// optimiser that moves the flat output: thrusts, yaw rate and |w| as functions of z', z'', z''',
// z''''.
#pragma once

#include <Eigen/Core>

#include "otter_nav/vessel/flatness.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

// Derivatives of a scalar with respect to velocity, acceleration, jerk and snap (columns).
using FlatRow = Eigen::Matrix<double, 2, 4>;

struct FlatGradient {
  double heading_force_n = 0.0;  // |w|
  double yaw_rate_radps = 0.0;
  double surge_n = 0.0;                           // F_r + F_l
  double difference_n = 0.0;                      // F_r - F_l
  Eigen::Vector2d bow = Eigen::Vector2d::Zero();  // w / |w|
  FlatRow heading_force = FlatRow::Zero();
  FlatRow yaw_rate = FlatRow::Zero();
  FlatRow surge = FlatRow::Zero();
  FlatRow difference = FlatRow::Zero();
};

// |w| is taken as no less than `force_floor_n`, so that values stay finite.
[[nodiscard]] FlatGradient flatGradient(const vessel::FlatPoint& z,
                                        const vessel::Parameters& vessel, double force_floor_n);

// The values alone.
struct FlatValues {
  double heading_force_n;
  double yaw_rate_radps;
  double surge_n;
  double difference_n;
};
[[nodiscard]] FlatValues flatValues(const vessel::FlatPoint& z, const vessel::Parameters& vessel,
                                    double force_floor_n);

}  // namespace otter_nav::optimizer
