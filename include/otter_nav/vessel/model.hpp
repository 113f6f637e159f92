// The planar models as state equations: x' = f(x, F) (paper, equations 1 to 6; docs/model.md).
#pragma once

#include "otter_nav/vessel/motion_law.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::vessel {

// What `disturbance` pushes with on heading psi, body frame (the current apart: it acts through the
// drag).
struct OutsideLoad {
  double surge_n = 0.0;
  double sway_n = 0.0;
  double yaw_nm = 0.0;
};
[[nodiscard]] OutsideLoad outsideLoad(double psi_rad, const ManoeuvringModel& model,
                                      const Disturbance& disturbance);

// x' for thrusts F by the equations of vessel/motion_law.hpp. Body velocities in `state` are over
// ground. Note on the paper: its equation 3 prints m2 where the sway inertia m1 belongs; the
// consistent matrix is built here.
[[nodiscard]] State stateDerivative(const State& state, const Thrusts& thrusts,
                                    const ManoeuvringModel& model, const Thrusters& thrusters,
                                    const Disturbance& disturbance);

// The derivative's Jacobians with respect to state and thrusts.
struct Linearization {
  State derivative;
  StateJacobian state_jacobian;
  InputJacobian input_jacobian;
  Eigen::Matrix<double, 3, 2> current_jacobian;  // d (u', v', r') / d current, earth frame
};
[[nodiscard]] Linearization linearize(const State& state, const Thrusts& thrusts,
                                      const ManoeuvringModel& model, const Thrusters& thrusters,
                                      const Disturbance& disturbance);

}  // namespace otter_nav::vessel
