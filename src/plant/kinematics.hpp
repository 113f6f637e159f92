// Rotations and spatial matrices of Fossen (2021), chapters 2 and 3: zyx Euler angles.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "otter_nav/plant/plant_model.hpp"

namespace otter_nav::plant {

// S(a) b = a x b.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d s;
  s << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return s;
}

// Sines and cosines of roll and pitch, shared by the two maps below.
struct Attitude {
  Attitude(double roll, double pitch, double yaw)
      : sin_roll(std::sin(roll)),
        cos_roll(std::cos(roll)),
        sin_pitch(std::sin(pitch)),
        cos_pitch(std::cos(pitch)),
        sin_yaw(std::sin(yaw)),
        cos_yaw(std::cos(yaw)) {}

  // Earth from body.
  [[nodiscard]] Eigen::Matrix3d rotation() const {
    Eigen::Matrix3d r;
    r << cos_yaw * cos_pitch, -sin_yaw * cos_roll + cos_yaw * sin_pitch * sin_roll,
        sin_yaw * sin_roll + cos_yaw * sin_pitch * cos_roll,  //
        sin_yaw * cos_pitch, cos_yaw * cos_roll + sin_yaw * sin_pitch * sin_roll,
        -cos_yaw * sin_roll + sin_yaw * sin_pitch * cos_roll,  //
        -sin_pitch, cos_pitch * sin_roll, cos_pitch * cos_roll;
    return r;
  }

  // Rates of roll, pitch and yaw for a body angular velocity; singular at 90 degrees of pitch.
  [[nodiscard]] Eigen::Vector3d eulerRates(const Eigen::Vector3d& w) const {
    const double turning = sin_roll * w.y() + cos_roll * w.z();
    return {w.x() + turning * sin_pitch / cos_pitch, cos_roll * w.y() - sin_roll * w.z(),
            turning / cos_pitch};
  }

  // The direction of gravity seen from the body.
  [[nodiscard]] Eigen::Vector3d down() const {
    return {-sin_pitch, cos_pitch * sin_roll, cos_pitch * cos_roll};
  }

  double sin_roll, cos_roll, sin_pitch, cos_pitch, sin_yaw, cos_yaw;
};

// eta' where tilts stay below a tenth of a radian, so that plane and tilt are kept apart.
inline Vector6 levelPoseRate(const PlantState& x) {
  const double c = std::cos(x[kYaw]);
  const double s = std::sin(x[kYaw]);
  Vector6 rate;
  rate << c * x[kU] - s * x[kV], s * x[kU] + c * x[kV], x[kW], x[kP], x[kQ], x[kR];
  return rate;
}

// H(r): moves velocities from the origin to a point at r; M_origin = H' M_point H.
inline Matrix6 movedBy(const Eigen::Vector3d& r) {
  Matrix6 h = Matrix6::Identity();
  h.topRightCorner<3, 3>() = skew(r).transpose();
  return h;
}

}  // namespace otter_nav::plant
