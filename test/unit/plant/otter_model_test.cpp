#include "plant/otter_model.hpp"

#include <gtest/gtest.h>

#include "plant/hoerner.hpp"

namespace otter_nav::plant {
namespace {

TEST(OtterModel, FloatsWhereThePayloadPutsIt) {
  const OtterModel loaded({25.0, {0.05, 0.0, -0.35}}, false);
  EXPECT_NEAR(loaded.settled()[kDown], 0.0377126086, 1e-9);
  EXPECT_NEAR(loaded.settled()[kPitch], -0.0260164426, 1e-9);
  EXPECT_NEAR(loaded.draft(), 0.195, 1e-3);
  const OtterModel empty({0.0, {0.05, 0.0, -0.35}}, false);
  EXPECT_EQ(empty.settled().norm(), 0.0);
  EXPECT_NEAR(empty.draft(), 0.134, 1e-3);
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
