#include "otter_model.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "hoerner.hpp"
#include "kinematics.hpp"

namespace otter_nav::plant {
namespace {

// Main particulars (MSS, otter.m; the maker's data sheet).
constexpr double kWaterDensity = 1025.0;
constexpr double kLength = 2.0;
constexpr double kHullMass = 55.0;
constexpr double kTopSpeed = 6.0 * 0.5144;
constexpr double kRollGyration = 0.4 * 1.08;
constexpr double kPitchGyration = 0.25 * kLength;
constexpr double kYawGyration = 0.25 * kLength;
// Bollard pull of both propellers: 24.4 kg ahead, 13.6 kg astern.
constexpr double kAheadPull = 24.4 * kGravity;
constexpr double kAsternPull = 13.6 * kGravity;
constexpr double kPropellerLag = 0.1;
// One pontoon.
constexpr double kPontoonBeam = 0.25;
constexpr double kPontoonOffset = 0.395;  // also the propellers' lever arm
constexpr double kWaterplane = 0.75;
constexpr double kBlock = 0.4;
constexpr double kFlotationCentre = -0.2;
// Settling behaviour that the damping is tuned to.
constexpr double kSwayTime = 1.0;
constexpr double kYawTime = 1.0;
constexpr double kYawNonlinearity = 10.0;
// Above water, estimated from the maker's drawings (frame and deck, mast left out), and wind
// coefficients in the middle of Fossen's ranges for small craft (2021, section 10.1).
constexpr double kAirDensity = 1.2;
constexpr double kFrontalArea = 0.45;
constexpr double kLateralArea = 0.75;
constexpr double kWindSurge = 0.7;
constexpr double kWindSway = 0.8;
constexpr double kWindYaw = 0.1;

Eigen::Vector3d hullCentreOfGravity() {
  return {0.2, 0.0, -0.2};
}

// Air moving at (u, v) relative to the hull, seen from the hull: Fossen's c_X = -c_x cos(gamma),
// c_Y = c_y sin(gamma), c_N = c_n sin(2 gamma), written without angles.
Vector6 airLoad(double u, double v) {
  const double pressure = 0.5 * kAirDensity * std::hypot(u, v);
  Vector6 load = Vector6::Zero();
  load[kU] = -kWindSurge * kFrontalArea * pressure * u;
  load[kV] = -kWindSway * kLateralArea * pressure * v;
  load[kR] = -kWindYaw * kLateralArea * kLength * kAirDensity * u * v;
  return load;
}

Vector6 poseRateAbout(const Eigen::Vector3d& trim_pose, const PlantState& x) {
  const Attitude attitude(x[kRoll] - trim_pose[1], x[kPitch] - trim_pose[2], x[kYaw]);
  Vector6 rate;
  const Eigen::Vector3d velocity = x.head<3>();
  rate.head<3>() = attitude.rotation() * velocity;
  rate.tail<3>() = attitude.eulerRates(x.segment<3>(kP));
  return rate;
}

}  // namespace

OtterModel::OtterModel(const PayloadOptions& payload, bool propeller_lag)
    : PlantModel(propeller_lag ? kPropellerLag : 0.0),
      payload_(payload),
      propeller_{0.02216 / 2.0, 0.01289 / 2.0, 0.5 * kAheadPull, 0.5 * kAsternPull},
      mass_kg_(kHullMass + payload.mass_kg) {
  setUpInertia();
  setUpHydrostatics();
  setUpDamping();
}

void OtterModel::setUpInertia() {
  const double payload = payload_.mass_kg;
  centre_of_gravity_ =
      (kHullMass * hullCentreOfGravity() + payload * payload_.position_m) / mass_kg_;
  const Eigen::Matrix3d hull_arm = skew(hullCentreOfGravity() - centre_of_gravity_);
  const Eigen::Matrix3d payload_arm = skew(payload_.position_m - centre_of_gravity_);
  gravity_inertia_ = -kHullMass * hull_arm * hull_arm - payload * payload_arm * payload_arm;
  gravity_inertia_.diagonal() +=
      kHullMass * Eigen::Vector3d(kRollGyration, kPitchGyration, kYawGyration).cwiseAbs2();

  Matrix6 about_gravity = Matrix6::Zero();
  about_gravity.topLeftCorner<3, 3>() = mass_kg_ * Eigen::Matrix3d::Identity();
  about_gravity.bottomRightCorner<3, 3>() = gravity_inertia_;
  const Matrix6 h = movedBy(centre_of_gravity_);
  inertia_ = h.transpose() * about_gravity * h;

  // Surge: Soeding (1982). The others are fractions of the hull's own inertia.
  const double hull_volume = kHullMass / kWaterDensity;
  added_mass_ << 2.7 * kWaterDensity * std::pow(hull_volume, 5.0 / 3.0) / (kLength * kLength),
      1.5 * kHullMass, kHullMass, 0.2 * gravity_inertia_(0, 0), 0.8 * gravity_inertia_(1, 1),
      1.7 * gravity_inertia_(2, 2);
  inertia_.diagonal() += added_mass_;
  inertia_inverse_ = inertia_.inverse();
}

// Metacentric stiffness (Fossen 2021, section 4.2) at the centre of flotation, moved to midships.
void OtterModel::setUpHydrostatics() {
  const double volume = mass_kg_ / kWaterDensity;
  draft_m_ = volume / (2.0 * kBlock * kPontoonBeam * kLength);
  const double area = kWaterplane * kLength * kPontoonBeam;
  const double transverse = kLength * std::pow(kPontoonBeam, 3) * std::pow(kWaterplane, 3) /
                                ((1.0 + kWaterplane) * (1.0 + 2.0 * kWaterplane)) +
                            2.0 * area * kPontoonOffset * kPontoonOffset;
  const double longitudinal = 0.8 / 6.0 * kPontoonBeam * std::pow(kLength, 3);
  const double buoyancy_centre = (2.5 * draft_m_ - 0.5 * volume / (kLength * kPontoonBeam)) / 3.0;
  const double gravity_centre = draft_m_ - centre_of_gravity_.z();

  const double weight_density = kWaterDensity * kGravity;
  Matrix6 at_flotation = Matrix6::Zero();
  at_flotation(kW, kW) = weight_density * 2.0 * area;
  at_flotation(kP, kP) =
      weight_density * volume * (buoyancy_centre + transverse / volume - gravity_centre);
  at_flotation(kQ, kQ) =
      weight_density * volume * (buoyancy_centre + longitudinal / volume - gravity_centre);
  const Matrix6 h = movedBy({kFlotationCentre, 0.0, 0.0});
  stiffness_ = h.transpose() * at_flotation * h;
  vertical_compliance_ = stiffness_.block<3, 3>(kW, kW).inverse();
}

void OtterModel::setUpDamping() {
  // Heave, roll and pitch by their damping ratios; pitch's natural frequency is taken with the
  // stiffness about the centre of flotation, as in the reference.
  const auto critical = [&](int i, double stiffness) {
    return 2.0 * std::sqrt(stiffness * inertia_(i, i));
  };
  const double pitch_stiffness =
      stiffness_(kQ, kQ) - kFlotationCentre * kFlotationCentre * stiffness_(kW, kW);
  damping_ << kAheadPull / kTopSpeed, inertia_(kV, kV) / kSwayTime,
      0.3 * critical(kW, stiffness_(kW, kW)), 0.2 * critical(kP, stiffness_(kP, kP)),
      0.4 * critical(kQ, pitch_stiffness), inertia_(kR, kR) / kYawTime;
  crossflow_ = 0.5 * kWaterDensity * draft_m_ * hoernerDrag(kPontoonBeam, draft_m_);
}

// C_RB of the rigid body in its rate-only form plus C_A (Fossen 2021, theorem 3.2), times nu_r.
Vector6 OtterModel::coriolis(const Vector6& velocity, const Vector6& velocity_water) const {
  const Eigen::Vector3d w = velocity.tail<3>();
  const Eigen::Vector3d v_water = velocity_water.head<3>();
  const Eigen::Vector3d w_water = velocity_water.tail<3>();
  const Eigen::Vector3d rigid_force =
      mass_kg_ * w.cross(v_water + w_water.cross(centre_of_gravity_));
  const Eigen::Vector3d added_linear = added_mass_.head<3>().cwiseProduct(v_water);
  const Eigen::Vector3d added_angular = added_mass_.tail<3>().cwiseProduct(w_water);
  Vector6 c;
  c.head<3>() = rigid_force + w_water.cross(added_linear);
  c.tail<3>() = centre_of_gravity_.cross(rigid_force) + w_water.cross(gravity_inertia_ * w) +
                v_water.cross(added_linear) + w_water.cross(added_angular);
  return c;
}

Vector6 OtterModel::linearDrag(const Vector6& velocity_water) const {
  Vector6 drag = -damping_.cwiseProduct(velocity_water);
  drag[kR] *= 1.0 + kYawNonlinearity * std::abs(velocity_water[kR]);
  return drag;
}

// Strip theory (Fossen 2021, section 6.4.3): 21 sections from stern to bow, a twentieth of the
// length each, both ends in full as in the reference.
Vector6 OtterModel::crossFlowDrag(const Vector6& velocity_water) const {
  constexpr int kStrips = 20;
  constexpr double kStrip = kLength / kStrips;
  double sway = 0.0;
  double heave = 0.0;
  double pitch = 0.0;
  double yaw = 0.0;
  for (int i = 0; i <= kStrips; ++i) {
    const double x = i * kStrip - 0.5 * kLength;
    const double across = velocity_water[kV] + x * velocity_water[kR];
    const double down = velocity_water[kW] + x * velocity_water[kQ];
    const double across_squared = std::abs(across) * across;
    const double down_squared = std::abs(down) * down;
    sway += across_squared;
    heave += down_squared;
    pitch += x * down_squared;
    yaw += x * across_squared;
  }
  Vector6 drag;
  drag << 0.0, sway, heave, 0.0, pitch, yaw;
  return -crossflow_ * kStrip * drag;
}

Eigen::Vector3d OtterModel::trim(double roll_rad, double pitch_rad) const {
  const Eigen::Vector3d force =
      payload_.mass_kg * kGravity * Attitude(roll_rad, pitch_rad, 0.0).down();
  const Eigen::Vector3d moment = payload_.position_m.cross(force);
  return vertical_compliance_ * Eigen::Vector3d(force.z(), moment.x(), moment.y());
}

PlantState OtterModel::hullDerivative(const PlantState& x, const Surroundings& around) const {
  const Vector6 nu = velocityOf(x);
  const Vector6 nu_water = nu - around.water_velocity;
  Vector6 nu_surface = nu_water;  // what damps: relative to the moving surface, too
  nu_surface.segment<3>(kW) -= around.surface_rate;
  const Eigen::Vector3d trim_pose = trim(x[kRoll], x[kPitch]);
  const Eigen::Vector3d displaced = x.segment<3>(kDown) - trim_pose - around.surface;

  const vessel::Thrusts thrust = thrusts(x);
  Vector6 force =
      around.force + linearDrag(nu_surface) + crossFlowDrag(nu_surface) - coriolis(nu, nu_water);
  force[kU] += thrust.sum();
  force[kR] += kPontoonOffset * (thrust[vessel::kLeft] - thrust[vessel::kRight]);
  force.segment<3>(kW) -= stiffness_.block<3, 3>(kW, kW) * displaced;

  PlantState dx;
  dx.head<6>() = inertia_inverse_ * force + around.water_acceleration;
  // The water's velocity seen from the turning body.
  dx.head<3>() -= nu.tail<3>().cross(around.water_velocity.head<3>());
  dx.segment<6>(kNorth) = poseRateAbout(trim_pose, x);
  return dx;
}

Vector6 OtterModel::poseRate(const PlantState& x) const {
  return poseRateAbout(trim(x[kRoll], x[kPitch]), x);
}

// The trim depends on the attitude it brings about, by under a thousandth: a few rounds settle it.
PlantState OtterModel::settled() const {
  constexpr int kRounds = 20;
  PlantState x = PlantState::Zero();
  for (int i = 0; i < kRounds; ++i) {
    x.segment<3>(kDown) = trim(x[kRoll], x[kPitch]);
  }
  return x;
}

Eigen::Vector2d OtterModel::commandFor(const vessel::Thrusts& thrusts_n) const {
  return {propeller_.speedFor(thrusts_n[0]), propeller_.speedFor(thrusts_n[1])};
}

Eigen::Vector2d OtterModel::saturate(const Eigen::Vector2d& command) const {
  return {propeller_.saturate(command[0]), propeller_.saturate(command[1])};
}

vessel::Thrusts OtterModel::thrusts(const PlantState& x) const {
  return {propeller_.thrust(x[kPropeller]), propeller_.thrust(x[kPropeller + 1])};
}

// The surge drag was measured in air at rest, so the air that the hull's own way meets is in it
// already: only the difference that wind makes is added.
Vector6 OtterModel::windForce(const Eigen::Vector2d& wind_in_body, const Vector6& velocity) const {
  return airLoad(velocity[kU] - wind_in_body.x(), velocity[kV] - wind_in_body.y()) -
         airLoad(velocity[kU], velocity[kV]);
}

Eigen::Vector2d OtterModel::gridHalfSize() const {
  // Two Gauss points along each pontoon.
  return {0.5 * kLength / std::sqrt(3.0), kPontoonOffset};
}

}  // namespace otter_nav::plant
