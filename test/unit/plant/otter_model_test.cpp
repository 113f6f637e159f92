#include "otter_nav/plant/otter_model.hpp"

#include <gtest/gtest.h>

#include "otter_nav/plant/hoerner.hpp"

namespace otter_nav::plant {
namespace {

Surroundings calm(const PlantState& /*x*/) {
  return {};
}

TEST(OtterModel, FloatsWhereThePayloadPutsIt) {
  const OtterModel loaded({25.0, {0.05, 0.0, -0.35}}, false);
  EXPECT_NEAR(loaded.settled()[kDown], 0.0377126086, 1e-9);
  EXPECT_NEAR(loaded.settled()[kPitch], -0.0260164426, 1e-9);
  EXPECT_NEAR(loaded.draft(), 0.195, 1e-3);
  const OtterModel empty({0.0, {0.05, 0.0, -0.35}}, false);
  EXPECT_EQ(empty.settled().norm(), 0.0);
  EXPECT_NEAR(empty.draft(), 0.134, 1e-3);
}

TEST(OtterModel, ReachesSixKnotsAtFullThrust) {
  const OtterModel model({}, true);
  PlantState x = model.settled();
  const Eigen::Vector2d full = model.commandFor({1e3, 1e3});
  for (int i = 0; i < 3000; ++i) x = step(model, x, full, 0.01, calm);
  EXPECT_NEAR(x[kU], 3.09, 0.02 * 3.09);
}

TEST(OtterModel, SaturatesThrustsAndInvertsThePropellersCurve) {
  const OtterModel model({}, true);
  PlantState x = model.settled();
  x.tail<2>() = model.commandFor({1e3, -1e3});
  EXPECT_NEAR(model.thrusts(x)[0], 119.7, 0.1);
  EXPECT_NEAR(model.thrusts(x)[1], -66.7, 0.1);
  for (const double thrust : {-60.0, -1.0, 0.0, 0.5, 110.0}) {
    x.tail<2>() = model.commandFor({thrust, -0.5 * thrust});
    EXPECT_NEAR(model.thrusts(x)[0], thrust, 1e-9);
    EXPECT_NEAR(model.thrusts(x)[1], -0.5 * thrust, 1e-9);
  }
}

TEST(OtterModel, PropellersLagByATenthOfASecond) {
  const OtterModel model({}, true);
  PlantState x = model.settled();
  for (int i = 0; i < 10; ++i) x = step(model, x, {50.0, -50.0}, 0.01, calm);
  EXPECT_NEAR(x[kPropeller], 50.0 * (1.0 - std::exp(-1.0)), 1e-4);
  EXPECT_NEAR(x[kPropeller + 1], -50.0 * (1.0 - std::exp(-1.0)), 1e-4);
  const OtterModel at_once({}, false);
  x = step(at_once, at_once.settled(), {50.0, -50.0}, 0.01, calm);
  EXPECT_EQ(x[kPropeller], 50.0);
}

// Without thrust a current carries the hull along, whatever way it points.
TEST(OtterModel, DriftsWithTheCurrentInTheEnd) {
  const OtterModel model({}, true);
  PlantState x = model.settled();
  x[kYaw] = 0.7;
  for (int i = 0; i < 8000; ++i) {
    x = step(model, x, {0.0, 0.0}, 0.01, [](const PlantState& state) {
      Surroundings around;
      around.water_velocity[kU] = 0.5 * std::cos(state[kYaw]);
      around.water_velocity[kV] = -0.5 * std::sin(state[kYaw]);
      return around;
    });
  }
  const Vector6 rate = model.poseRate(x);
  EXPECT_NEAR(rate[0], 0.5, 0.01);
  EXPECT_NEAR(rate[1], 0.0, 0.01);
}

TEST(OtterModel, WindPushesAndStillAirDoesNot) {
  const OtterModel model({}, true);
  Vector6 nu = Vector6::Zero();
  nu[kU] = 2.0;
  nu[kV] = -0.3;
  EXPECT_NEAR(model.windForce({0.0, 0.0}, nu).norm(), 0.0, 1e-12);
  // From ahead it holds the hull back, more so the faster it sails into it.
  const double at_rest = model.windForce({-5.0, 0.0}, Vector6::Zero())[kU];
  EXPECT_NEAR(at_rest, -0.5 * 1.2 * 0.7 * 0.45 * 25.0, 1e-9);
  nu[kV] = 0.0;
  EXPECT_LT(model.windForce({-5.0, 0.0}, nu)[kU], at_rest);
  // From port it pushes to starboard.
  EXPECT_GT(model.windForce({0.0, 5.0}, Vector6::Zero())[kV], 0.0);
}

TEST(Hoerner, FollowsItsCurve) {
  EXPECT_DOUBLE_EQ(hoernerDrag(2.0 * 0.988002, 1.0), 0.828415);
  EXPECT_DOUBLE_EQ(hoernerDrag(0.001, 1.0), 1.96608);
  EXPECT_DOUBLE_EQ(hoernerDrag(100.0, 1.0), 0.559315);
  const double between = hoernerDrag(2.0 * 0.9, 1.0);
  EXPECT_LT(between, 0.87959);
  EXPECT_GT(between, 0.828415);
}

}  // namespace
}  // namespace otter_nav::plant
