// The flatness map (vessel/flatness.hpp, still water, bow along w) with its derivatives, for an
// optimiser that moves the flat output: thrusts, yaw rate and |w| as functions of z', z'', z''',
// z''''.
#pragma once

#include <Eigen/Core>
#include <algorithm>

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

// w = m1 z'' + d2 z' with what depends on it, for terms that need no thrust.
class Dynamics {
 public:
  explicit Dynamics(const vessel::Parameters& vessel) : vessel_(vessel) {}

  struct Bow {
    Eigen::Vector2d ahead;
    double firmness_n;
  };
  [[nodiscard]] FlatGradient gradient(const vessel::FlatPoint& z, double floor_n) const {
    return flatGradient(z, vessel_, floor_n);
  }
  [[nodiscard]] Eigen::Vector2d headingForce(const Eigen::Vector2d& velocity,
                                             const Eigen::Vector2d& acceleration) const {
    return vessel_.paper.m1_kg * acceleration + vessel_.paper.d2_kgps * velocity;
  }
  // d scalar / d (z', ..., z'''') from its derivative by w.
  [[nodiscard]] FlatRow byPath(const Eigen::Vector2d& by_w) const {
    FlatRow row = FlatRow::Zero();
    row.col(0) = vessel_.paper.d2_kgps * by_w;
    row.col(1) = vessel_.paper.m1_kg * by_w;
    return row;
  }
  [[nodiscard]] Bow bow(const Eigen::Vector2d& w, const Eigen::Vector2d& /*ahead*/,
                        double floor_n) const {
    const double norm = std::max(w.norm(), floor_n);
    return {w / norm, norm};
  }
  // d (vector . bow) / d w.
  [[nodiscard]] static Eigen::Vector2d bowGradient(const Bow& bow, const Eigen::Vector2d& vector) {
    return (vector - vector.dot(bow.ahead) * bow.ahead) / bow.firmness_n;
  }

 private:
  vessel::Parameters vessel_;
};

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
