#include "planar_model.hpp"

#include "kinematics.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::plant {
namespace {

// A light catamaran's heave, roll and pitch: stiff on the water, so long waves are ridden; those
// shorter than the hull cancel over its grid.
constexpr double kRidingFrequency = 6.0;  // rad/s
constexpr double kRidingDamping = 0.5;    // of critical

}  // namespace

// The vessel's model is asked on heading 0, where its earth frame is the body's, port for
// starboard.
PlantState PlanarModel::hullDerivative(const PlantState& x, const Surroundings& around) const {
  vessel::State state = vessel::State::Zero();
  state[vessel::kSurge] = x[kU];
  state[vessel::kSway] = -x[kV];
  state[vessel::kYawRate] = -x[kR];
  vessel::Disturbance acting;
  acting.current_mps = {around.water_velocity[kU], -around.water_velocity[kV]};
  acting.force_n = {around.force[kU], -around.force[kV]};
  acting.moment_nm = -around.force[kR];
  const vessel::State rate =
      vessel::stateDerivative(state, thrusts(x), vessel_.manoeuvring, vessel_.thrusters, acting);
  PlantState dx = PlantState::Zero();
  dx[kU] = rate[vessel::kSurge] + around.water_acceleration[kU];
  dx[kV] = -rate[vessel::kSway] + around.water_acceleration[kV];
  dx[kR] = -rate[vessel::kYawRate] + around.water_acceleration[kR];
  dx.segment<3>(kW) =
      kRidingFrequency * kRidingFrequency * (around.surface - x.segment<3>(kDown)) +
      2.0 * kRidingDamping * kRidingFrequency * (around.surface_rate - x.segment<3>(kW));
  dx.segment<6>(kNorth) = levelPoseRate(x);
  return dx;
}

Eigen::Vector2d PlanarModel::saturate(const Eigen::Vector2d& command) const {
  return vessel::clampThrusts(command, vessel_.thrusters);
}

Vector6 PlanarModel::windForce(const Eigen::Vector2d& wind_in_body,
                               const Vector6& /*velocity*/) const {
  vessel::Disturbance wind;
  wind.wind_mps = {wind_in_body.x(), -wind_in_body.y()};
  const vessel::OutsideLoad load = vessel::outsideLoad(0.0, vessel_.manoeuvring, wind);
  Vector6 force = Vector6::Zero();
  force[kU] = load.surge_n;
  force[kV] = -load.sway_n;
  force[kR] = -load.yaw_nm;
  return force;
}

// Two Gauss points along each pontoon; the thrusters sit on the pontoons.
Eigen::Vector2d PlanarModel::gridHalfSize() const {
  return {0.5 * vessel_.hull.length_m / std::sqrt(3.0), vessel_.thrusters.lever_arm_m};
}

}  // namespace otter_nav::plant
