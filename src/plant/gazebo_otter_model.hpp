// The Otter of the paper's simulator (Gazebo; docs/plant.md). In the plane three equations: rigid
// mass 30 kg, added mass 5 kg that enters as -Ma times acceleration only (so the centripetal terms
// carry the rigid mass alone), linear drag, no quadratic drag:
//   35 (u' - u_w') = 30 v_w r - 20 u_w + X,  35 (v' - v_w') = -30 u_w r - 20 v_w + Y,
//   11 (r' - r_w') = -20 r_w + N             (u_w, v_w, r_w through the water)
// Heave, roll and pitch come from buoyancy on two pontoons' half cylinders, two sections each.
#pragma once

#include "otter_nav/plant/plant_model.hpp"

namespace otter_nav::plant {

class GazeboOtterModel final : public PlantModel {
 public:
  // That simulator's thrusters have no lag; the propeller states are thrusts.
  GazeboOtterModel();

  [[nodiscard]] PlantState settled() const override;
  [[nodiscard]] Eigen::Vector2d saturate(const Eigen::Vector2d& command) const override;
  [[nodiscard]] Vector6 windForce(const Eigen::Vector2d& wind_in_body,
                                  const Vector6& velocity) const override;
  [[nodiscard]] Eigen::Vector2d gridHalfSize() const override;
  [[nodiscard]] double draft() const override { return draft_m_; }
  // That simulator's waves act through buoyancy alone, which is upright.
  [[nodiscard]] bool wavesCarryInPlane() const override { return false; }

 private:
  [[nodiscard]] PlantState hullDerivative(const PlantState& x,
                                          const Surroundings& around) const override;
  // [Z K M] of buoyancy and weight for the pose [z phi theta] over the surface's plane.
  [[nodiscard]] Eigen::Vector3d restoring(const Eigen::Vector3d& pose,
                                          const Eigen::Vector3d& surface) const;

  double draft_m_ = 0.0;
};

}  // namespace otter_nav::plant
