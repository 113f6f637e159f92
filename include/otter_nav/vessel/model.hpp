// The planar models as state equations: x' = f(x, F) (paper, equations 1 to 6; docs/model.md).
#pragma once

#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::vessel {

// What acts beside the thrusters: water moving with `current` (earth frame, m/s, irrotational and
// steady), air moving with `wind` (earth frame, m/s), a force fixed in the earth frame, a yaw
// moment.
struct Disturbance {
  Eigen::Vector2d current_mps = Eigen::Vector2d::Zero();
  Eigen::Vector2d wind_mps = Eigen::Vector2d::Zero();
  Eigen::Vector2d force_n = Eigen::Vector2d::Zero();
  double moment_nm = 0.0;
};

// What `disturbance` pushes with on heading psi, body frame, and how that changes with psi (the
// current apart: it acts through the drag).
struct OutsideLoad {
  double surge_n = 0.0;
  double sway_n = 0.0;
  double yaw_nm = 0.0;
  double surge_slope_n = 0.0;  // per rad
  double sway_slope_n = 0.0;
  double yaw_slope_nm = 0.0;
};
[[nodiscard]] OutsideLoad outsideLoad(double psi_rad, const ManoeuvringModel& model,
                                      const Disturbance& disturbance);

// x' for thrusts F. The body velocities in `state` are over ground; drag and centripetal terms act
// on the velocity through the water (Fossen 2021, section 10.3). Note on the paper: its equation 3
// prints m2 where the sway inertia m1 belongs; the consistent matrix is built here.
[[nodiscard]] State stateDerivative(const State& state, const Thrusts& thrusts,
                                    const ManoeuvringModel& model, const Thrusters& thrusters,
                                    const Disturbance& disturbance);

// The derivative's Jacobians with respect to state and thrusts, analytic.
struct Linearization {
  State derivative;
  StateJacobian state_jacobian;
  InputJacobian input_jacobian;
};
[[nodiscard]] Linearization linearize(const State& state, const Thrusts& thrusts,
                                      const ManoeuvringModel& model, const Thrusters& thrusters,
                                      const Disturbance& disturbance);

}  // namespace otter_nav::vessel
