#include "plant/gazebo_otter_model.hpp"

#include <gtest/gtest.h>

namespace otter_nav::plant {
namespace {

Surroundings calm(const PlantState& /*x*/) {
  return {};
}

TEST(GazeboOtterModel, WindLawIsItsSimulators) {
  const GazeboOtterModel model;
  const Vector6 force = model.windForce({-3.0, 2.0}, Vector6::Zero());
  EXPECT_DOUBLE_EQ(force[kU], -0.5 * 9.0);
  EXPECT_DOUBLE_EQ(force[kV], 0.5 * 4.0);
  // Seen from above with y to port: -2 * 0.33 * (-3) * (-2), counter-clockwise; down is opposite.
  EXPECT_DOUBLE_EQ(force[kR], 2.0 * 0.33 * 6.0);
}

TEST(GazeboOtterModel, FollowsALongWaveAndPitchesUpUnderThrust) {
  const GazeboOtterModel model;
  PlantState x = model.settled();
  for (int i = 0; i < 1500; ++i) {
    x = model.step(x, {0.0, 0.0}, 0.01, [](const PlantState& /*state*/) {
      Surroundings around;
      around.surface = {-0.05, 0.02, 0.03};
      return around;
    });
  }
  EXPECT_NEAR(x[kDown], model.draft() - 0.05, 1e-3);
  EXPECT_NEAR(x[kRoll], 0.02, 3e-3);
  EXPECT_NEAR(x[kPitch], 0.03, 5e-3);
  for (int i = 0; i < 1500; ++i) x = model.step(x, {50.0, 50.0}, 0.01, calm);
  EXPECT_GT(x[kPitch], 0.03);
}

}  // namespace
}  // namespace otter_nav::plant
