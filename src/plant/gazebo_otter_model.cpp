#include "gazebo_otter_model.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics.hpp"

namespace otter_nav::plant {
namespace {

// The figures of that simulator's vessel description and plugins.
constexpr double kWaterDensity = 997.8;
constexpr double kMass = 30.0;
constexpr double kAddedMass = 5.0;
constexpr double kYawInertia = 10.0;
constexpr double kAddedYawInertia = 1.0;
constexpr double kTiltInertia = 10.1;  // roll and pitch, with added 0.1
constexpr double kHeaveMass = 30.1;
constexpr double kPlanarDrag = 20.0;  // surge, sway and yaw
constexpr double kHeaveDrag = 50.0;
constexpr double kTiltDrag = 20.0;
constexpr double kThrustMax = 50.0;
constexpr double kLeverArm = 0.39;
constexpr double kThrustBelowGravity = 0.36;
constexpr double kGravityHeight = 0.29;  // over base_link
// Pontoons: half cylinders, their axes' ends at base_link's height.
constexpr double kPontoonRadius = 0.213;
constexpr double kPontoonLength = 1.35;
constexpr double kPontoonOffset = 0.5;
constexpr double kSectionOffset = 0.25 * kPontoonLength;
constexpr double kWindSurge = 0.5;
constexpr double kWindSway = 0.5;
constexpr double kWindYaw = 0.33;

// Buoyancy, N, of one of the four sections immersed so deep.
double sectionBuoyancy(double immersion_m) {
  const double h = std::clamp(immersion_m, 0.0, kPontoonRadius);
  const double r = kPontoonRadius;
  const double area = r * r * std::acos((r - h) / r) - (r - h) * std::sqrt(h * (2.0 * r - h));
  return kWaterDensity * kGravity * 0.5 * kPontoonLength * area;
}

}  // namespace

GazeboOtterModel::GazeboOtterModel() : PlantModel(0.0) {
  constexpr int kBisections = 60;
  double low = 0.0;
  double high = kPontoonRadius;
  for (int i = 0; i < kBisections; ++i) {
    draft_m_ = 0.5 * (low + high);
    (4.0 * sectionBuoyancy(draft_m_) < kMass * kGravity ? low : high) = draft_m_;
  }
}

Eigen::Vector3d GazeboOtterModel::restoring(const Eigen::Vector3d& pose,
                                            const Eigen::Vector3d& surface) const {
  const double sin_roll = std::sin(pose[1]);
  const double sin_pitch = std::sin(pose[2]);
  double buoyancy = 0.0;
  double roll = 0.0;
  double pitch = 0.0;
  for (const double x : {-kSectionOffset, kSectionOffset}) {
    for (const double y : {-kPontoonOffset, kPontoonOffset}) {
      const double immersion =
          pose[0] - surface[0] - x * (sin_pitch - surface[2]) + y * (sin_roll - surface[1]);
      const double up = sectionBuoyancy(immersion);
      buoyancy += up;
      roll -= y * up;
      pitch += x * up;
    }
  }
  // The centre of gravity lies over base_link: the weight tips.
  const double tipping = kGravityHeight * kMass * kGravity;
  return {kMass * kGravity - buoyancy, roll * std::cos(pose[1]) + tipping * sin_roll,
          pitch * std::cos(pose[2]) + tipping * sin_pitch};
}

PlantState GazeboOtterModel::hullDerivative(const PlantState& x, const Surroundings& around) const {
  const Vector6 nu = velocityOf(x);
  const Vector6 nu_water = nu - around.water_velocity;
  const vessel::Thrusts thrust = thrusts(x);
  const double surge = thrust.sum();
  const double yaw = kLeverArm * (thrust[vessel::kLeft] - thrust[vessel::kRight]);
  const double r = nu[kR];
  const Vector6& force = around.force;

  PlantState dx = PlantState::Zero();
  dx[kU] = (kMass * nu_water[kV] * r - kPlanarDrag * nu_water[kU] + surge + force[kU]) /
               (kMass + kAddedMass) +
           r * around.water_velocity[kV] + around.water_acceleration[kU];
  dx[kV] =
      (-kMass * nu_water[kU] * r - kPlanarDrag * nu_water[kV] + force[kV]) / (kMass + kAddedMass) -
      r * around.water_velocity[kU] + around.water_acceleration[kV];
  dx[kR] = (-kPlanarDrag * nu_water[kR] + yaw + force[kR]) / (kYawInertia + kAddedYawInertia) +
           around.water_acceleration[kR];

  const Eigen::Vector3d vertical = restoring(x.segment<3>(kDown), around.surface);
  dx[kW] = (vertical[0] - kHeaveDrag * nu[kW]) / kHeaveMass;
  dx[kP] = (vertical[1] - kTiltDrag * nu[kP]) / kTiltInertia;
  dx[kQ] = (vertical[2] - kTiltDrag * nu[kQ] + kThrustBelowGravity * surge) / kTiltInertia;

  dx.segment<6>(kNorth) = levelPoseRate(x);
  return dx;
}

PlantState GazeboOtterModel::settled() const {
  PlantState x = PlantState::Zero();
  x[kDown] = draft_m_;
  return x;
}

Eigen::Vector2d GazeboOtterModel::saturate(const Eigen::Vector2d& command) const {
  return command.cwiseMax(-kThrustMax).cwiseMin(kThrustMax);
}

// That simulator's wind plugin: coefficients 0.5, 0.5, 0.33 on the true wind (not the apparent).
Vector6 GazeboOtterModel::windForce(const Eigen::Vector2d& wind_in_body,
                                    const Vector6& /*velocity*/) const {
  Vector6 force = Vector6::Zero();
  force[kU] = kWindSurge * std::abs(wind_in_body.x()) * wind_in_body.x();
  force[kV] = kWindSway * std::abs(wind_in_body.y()) * wind_in_body.y();
  force[kR] = -2.0 * kWindYaw * wind_in_body.x() * wind_in_body.y();
  return force;
}

Eigen::Vector2d GazeboOtterModel::gridHalfSize() const {
  return {kSectionOffset, kPontoonOffset};
}

}  // namespace otter_nav::plant
