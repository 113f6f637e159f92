// Any vessel from its file alone: the manoeuvring model in the plane (vessel/model.hpp), wind loads
// and thrust lag included. In the waves it rides: heave, roll and pitch follow the surface's plane
// as lightly damped oscillators, and nothing of them reaches the plane.
#pragma once

#include "otter_nav/plant/plant_model.hpp"

namespace otter_nav::plant {

class PlanarModel final : public PlantModel {
 public:
  // The propeller states are thrusts.
  explicit PlanarModel(const vessel::Parameters& vessel)
      : PlantModel(vessel.thrusters.lag_s), vessel_(vessel) {}

  [[nodiscard]] PlantState settled() const override { return PlantState::Zero(); }
  [[nodiscard]] Eigen::Vector2d saturate(const Eigen::Vector2d& command) const override;
  [[nodiscard]] Vector6 windForce(const Eigen::Vector2d& wind_in_body,
                                  const Vector6& velocity) const override;
  [[nodiscard]] Eigen::Vector2d gridHalfSize() const override;
  [[nodiscard]] double draft() const override { return 0.0; }
  [[nodiscard]] bool wavesCarryInPlane() const override { return false; }

 private:
  [[nodiscard]] PlantState hullDerivative(const PlantState& x,
                                          const Surroundings& around) const override;

  vessel::Parameters vessel_;
};

}  // namespace otter_nav::plant
