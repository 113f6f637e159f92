#include "otter_nav/vessel/flatness.hpp"

#include <cmath>

namespace otter_nav::vessel {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

FlatState stateFromFlat(const FlatPoint& z, const PaperModel& model, const Eigen::Vector2d& ahead,
                        const Eigen::Vector2d& current_mps) {
  const Eigen::Vector2d velocity_water = z.velocity - current_mps;
  const Eigen::Vector2d w = model.m1_kg * z.acceleration + model.d2_kgps * velocity_water;
  const Eigen::Vector2d w1 = model.m1_kg * z.jerk + model.d2_kgps * z.acceleration;
  const Eigen::Vector2d w2 = model.m1_kg * z.snap + model.d2_kgps * z.jerk;
  const double norm2 = w.squaredNorm();

  FlatState flat;
  flat.heading_force_n = std::sqrt(norm2);
  Eigen::Vector2d bow = ahead;
  double yaw_acceleration = 0.0;
  if (flat.heading_force_n > kSingularForceN) {
    bow = w.dot(ahead) >= 0.0 ? w : Eigen::Vector2d(-w);
    const double turn = cross(w, w1);
    flat.state[kYawRate] = turn / norm2;
    yaw_acceleration = (cross(w, w2) - 2.0 * flat.state[kYawRate] * w.dot(w1)) / norm2;
  }
  const double psi = std::atan2(bow.y(), bow.x());
  const Eigen::Vector2d e(std::cos(psi), std::sin(psi));
  flat.state[kX] = z.position.x();
  flat.state[kY] = z.position.y();
  flat.state[kPsi] = psi;
  flat.state[kSurge] = e.dot(z.velocity);
  flat.state[kSway] = cross(e, z.velocity);
  flat.tau.surge_n = model.m1_kg * e.dot(z.acceleration) + model.d1_kgps * e.dot(velocity_water);
  flat.tau.yaw_nm = model.m2_kgm2 * yaw_acceleration + model.d3_kgm2ps * flat.state[kYawRate];
  return flat;
}

}  // namespace otter_nav::vessel
