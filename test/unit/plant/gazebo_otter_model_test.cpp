#include "otter_nav/plant/gazebo_otter_model.hpp"

#include <gtest/gtest.h>

#include "otter_nav/plant/environment.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::plant {
namespace {

Surroundings calm(const PlantState& /*x*/) {
  return {};
}

TEST(GazeboOtterModel, ReachesFiveMetresASecond) {
  const GazeboOtterModel model;
  PlantState x = model.settled();
  for (int i = 0; i < 3000; ++i) x = step(model, x, {80.0, 80.0}, 0.01, calm);
  EXPECT_NEAR(x[kU], 5.0, 1e-3);
}

// The shipped planar model of this vessel is this plant's plane, current and forces included.
TEST(GazeboOtterModel, AgreesWithItsShippedPlanarModel) {
  const vessel::Parameters parameters = vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) +
                                                               "/config/vessels/otter_gazebo.yaml")
                                            .value();
  const GazeboOtterModel model;
  PlantState x = placed(model.settled(), {3.0, -1.0}, 0.4);
  x[kU] = 2.0;
  x[kV] = -0.3;
  x[kR] = -0.5;
  x.tail<2>() << 20.0, 35.0;
  Conditions conditions;
  conditions.current_mps = {0.3, -0.2};
  conditions.force_n = {5.0, 10.0};
  const PlantState dx = model.derivative(x, {20.0, 35.0}, surroundings(conditions, x, model));

  const vessel::State planar = toTruth(x, model.poseRate(x)).planar;
  vessel::Disturbance disturbance;
  disturbance.current_mps = conditions.current_mps;
  disturbance.force_n = conditions.force_n;
  const vessel::State expected = vessel::stateDerivative(
      planar, {20.0, 35.0}, parameters.manoeuvring, parameters.thrusters, disturbance);
  EXPECT_NEAR(dx[kEast], expected[vessel::kX], 1e-12);
  EXPECT_NEAR(dx[kNorth], expected[vessel::kY], 1e-12);
  EXPECT_NEAR(-dx[kYaw], expected[vessel::kPsi], 1e-12);
  EXPECT_NEAR(dx[kU], expected[vessel::kSurge], 1e-12);
  EXPECT_NEAR(-dx[kV], expected[vessel::kSway], 1e-12);
  EXPECT_NEAR(-dx[kR], expected[vessel::kYawRate], 1e-12);
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
    x = step(model, x, {0.0, 0.0}, 0.01, [](const PlantState& /*state*/) {
      Surroundings around;
      around.surface = {-0.05, 0.02, 0.03};
      return around;
    });
  }
  EXPECT_NEAR(x[kDown], model.draft() - 0.05, 1e-3);
  EXPECT_NEAR(x[kRoll], 0.02, 3e-3);
  EXPECT_NEAR(x[kPitch], 0.03, 5e-3);
  for (int i = 0; i < 1500; ++i) x = step(model, x, {50.0, 50.0}, 0.01, calm);
  EXPECT_GT(x[kPitch], 0.03);
}

}  // namespace
}  // namespace otter_nav::plant
