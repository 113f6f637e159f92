// The Maritime Robotics Otter in six degrees of freedom, as Fossen's MSS models it (otter.m,
// revision of June 2026; Fossen 2021, chapters 3 to 8). docs/plant.md has the equations.
//
//   M (nu' - nu_c') = tau + tau_wind + tau_drag + tau_crossflow - C(nu) nu_r - G (eta - eta_0)
//   eta' = J(eta - eta_0) nu
// with nu_r through the water and eta_0 the trim under the payload's weight. J takes the shifted
// angles because the reference does: the settled trim counts as level.
#pragma once

#include "otter_nav/plant/plant_model.hpp"
#include "propeller.hpp"

namespace otter_nav::plant {

class OtterModel final : public PlantModel {
 public:
  OtterModel(const PayloadOptions& payload, bool propeller_lag);

  [[nodiscard]] Vector6 poseRate(const PlantState& x) const override;
  [[nodiscard]] PlantState settled() const override;
  [[nodiscard]] Eigen::Vector2d commandFor(const vessel::Thrusts& thrusts_n) const override;
  [[nodiscard]] Eigen::Vector2d saturate(const Eigen::Vector2d& command) const override;
  [[nodiscard]] vessel::Thrusts thrusts(const PlantState& x) const override;
  [[nodiscard]] Vector6 windForce(const Eigen::Vector2d& wind_in_body,
                                  const Vector6& velocity) const override;
  [[nodiscard]] Eigen::Vector2d gridHalfSize() const override;
  [[nodiscard]] double draft() const override { return draft_m_; }
  [[nodiscard]] bool wavesCarryInPlane() const override { return true; }

  // Inertia with added mass, and stiffness, about midships.
  [[nodiscard]] const Matrix6& inertia() const { return inertia_; }
  [[nodiscard]] const Matrix6& stiffness() const { return stiffness_; }
  // [z phi theta] of the equilibrium while the hull is at this attitude.
  [[nodiscard]] Eigen::Vector3d trim(double roll_rad, double pitch_rad) const;

 private:
  [[nodiscard]] PlantState hullDerivative(const PlantState& x,
                                          const Surroundings& around) const override;
  void setUpInertia();
  void setUpHydrostatics();
  void setUpDamping();
  [[nodiscard]] Vector6 coriolis(const Vector6& velocity, const Vector6& velocity_water) const;
  [[nodiscard]] Vector6 linearDrag(const Vector6& velocity_water) const;
  [[nodiscard]] Vector6 crossFlowDrag(const Vector6& velocity_water) const;

  PayloadOptions payload_;
  Propeller propeller_;

  double mass_kg_ = 0.0;  // with payload
  double draft_m_ = 0.0;
  Eigen::Vector3d centre_of_gravity_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d gravity_inertia_ = Eigen::Matrix3d::Zero();  // about the centre of gravity
  Matrix6 inertia_ = Matrix6::Zero();
  Matrix6 inertia_inverse_ = Matrix6::Zero();
  Vector6 added_mass_ = Vector6::Zero();  // the diagonal
  Matrix6 stiffness_ = Matrix6::Zero();
  Eigen::Matrix3d vertical_compliance_ = Eigen::Matrix3d::Zero();  // of [z phi theta]
  Vector6 damping_ = Vector6::Zero();                              // linear, positive
  double crossflow_ = 0.0;  // 1/2 rho T Cd, N per (m/s)^2 and metre
};

}  // namespace otter_nav::plant
