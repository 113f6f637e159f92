#include "tracker/orbital_motion.hpp"

#include <gtest/gtest.h>

#include "otter_nav/base/random.hpp"

namespace otter_nav::tracker {
namespace {

OrbitalMotion::Vector someSea() {
  Random random(3);
  OrbitalMotion::Vector state;
  for (int i = 0; i < state.size(); ++i) {
    state[i] = 0.1 * random.normal();
  }
  return state;
}

TEST(OrbitalMotion, GoesOnAsItWasForeseen) {
  OrbitalMotion sea;
  sea.add(someSea());
  const WaterMotion foreseen = sea.at(1.7);
  for (int i = 0; i < 170; ++i) {
    sea.advance(0.01, OrbitalMotion::Vector::Zero());
  }
  EXPECT_LT((sea.at(0.0).velocity_mps - foreseen.velocity_mps).norm(), 1e-12);
  EXPECT_LT((sea.at(0.0).acceleration_mps2 - foreseen.acceleration_mps2).norm(), 1e-12);
}

TEST(OrbitalMotion, AcceleratesAsItsVelocityChanges) {
  OrbitalMotion sea;
  sea.add(someSea());
  constexpr double kAtOnceS = 1e-5;
  for (const double in_s : {0.1, 2.0, 5.0}) {
    const Eigen::Vector2d slope =
        (sea.at(in_s + kAtOnceS).velocity_mps - sea.at(in_s - kAtOnceS).velocity_mps) /
        (2.0 * kAtOnceS);
    EXPECT_LT((sea.at(in_s).acceleration_mps2 - slope).norm(), 1e-8) << "in " << in_s << " s";
  }
}

TEST(OrbitalMotion, SlopesAreThoseOfItsMotion) {
  const OrbitalMotion::Vector state = someSea();
  OrbitalMotion sea;
  sea.add(state);
  EXPECT_LT((OrbitalMotion::velocitySlope() * state - sea.at(0.0).velocity_mps).norm(), 1e-12);
  EXPECT_LT((OrbitalMotion::accelerationSlope() * state - sea.at(0.0).acceleration_mps2).norm(),
            1e-12);
  const OrbitalMotion::Vector later = OrbitalMotion::transition(0.8) * state;
  EXPECT_LT((OrbitalMotion::velocitySlope() * later - sea.at(0.8).velocity_mps).norm(), 1e-12);
}

// Left to its drive the variance stays what it is: a sea neither rises nor calms down by itself.
TEST(OrbitalMotion, DriveKeepsTheSeaUp) {
  const OrbitalMotion sea;
  constexpr double kShortS = 0.001;
  const OrbitalMotion::Matrix f = OrbitalMotion::transition(kShortS);
  OrbitalMotion::Matrix covariance = sea.variance().asDiagonal();
  for (int i = 0; i < 20000; ++i) {
    covariance = (f * covariance * f.transpose()).eval();
    covariance.diagonal() += kShortS * sea.drive();
  }
  for (int i = 0; i < OrbitalMotion::kSize; ++i) {
    EXPECT_NEAR(covariance(i, i) / sea.variance()[i], 1.0, 0.02) << i;
  }
}

// What it is told of the motion's size, it takes on within a minute or two, and keeps.
TEST(OrbitalMotion, LearnsHowHighTheSeaIs) {
  OrbitalMotion sea;
  const double calm = sea.drive().sum();
  OrbitalMotion::Vector variance = OrbitalMotion::Vector::Zero();
  variance.segment<2>(4 * 2 + 2).setConstant(0.04);
  for (int i = 0; i < 12000; ++i) {
    sea.advance(0.01, variance);
  }
  EXPECT_NEAR(sea.variance()[4 * 2 + 2], 0.04, 0.002);
  EXPECT_LT(sea.variance()[2], 0.001);
  EXPECT_GT(sea.drive().sum(), calm);
  sea.reset();
  EXPECT_NEAR(sea.variance()[4 * 2 + 2], 0.04, 0.002);
  EXPECT_EQ(sea.at(0.0).velocity_mps.norm(), 0.0);
}

// Carried by the water alone, a hull goes as the water does.
TEST(OrbitalMotion, TakesTheHullAlong) {
  const auto vessel =
      vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
  ASSERT_TRUE(vessel) << vessel.error().message;
  WaterMotion water;
  water.velocity_mps = {0.3, -0.1};
  water.acceleration_mps2 = {0.2, 0.5};
  vessel::State state = vessel::State::Zero();
  state[vessel::kPsi] = 0.5 * M_PI;
  state[vessel::kSurge] = -0.1;
  state[vessel::kSway] = -0.3;
  const vessel::State rate =
      derivativeInWater(state, vessel::Thrusts::Zero(), *vessel, vessel::Disturbance{}, water);
  EXPECT_NEAR(rate[vessel::kX], 0.3, 1e-12);
  EXPECT_NEAR(rate[vessel::kY], -0.1, 1e-12);
  EXPECT_NEAR(rate[vessel::kSurge], 0.5, 1e-9);
  EXPECT_NEAR(rate[vessel::kSway], -0.2, 1e-9);
}

}  // namespace
}  // namespace otter_nav::tracker
