#include "otter_nav/vessel/steady_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/vessel/model.hpp"

namespace otter_nav::vessel {
namespace {

Parameters windyVessel() {
  Parameters vessel;
  vessel.manoeuvring = ManoeuvringModel::fromPaper(vessel.paper);
  vessel.manoeuvring.wind_surge_kgpm = 0.5;
  vessel.manoeuvring.wind_sway_kgpm = 0.7;
  vessel.manoeuvring.wind_yaw_kg = -0.6;
  return vessel;
}

// What the answer claims, by the equations of motion: nothing changes.
void expectSteady(const SteadyMotion& motion, const Eigen::Vector2d& velocity,
                  const Parameters& vessel, const Disturbance& disturbance) {
  const double c = std::cos(motion.psi_rad);
  const double s = std::sin(motion.psi_rad);
  State x;
  x << 0.0, 0.0, motion.psi_rad, c * velocity.x() + s * velocity.y(),
      c * velocity.y() - s * velocity.x(), 0.0;
  const State dx =
      stateDerivative(x, motion.thrusts, vessel.manoeuvring, vessel.thrusters, disturbance);
  EXPECT_LT(dx.tail<3>().norm(), 1e-6);
}

TEST(SteadyMotion, AtRestInCalmWaterAnyHeadingWillDo) {
  const auto found = steadyHeadings(Eigen::Vector2d::Zero(), 1.2, windyVessel(), {});
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found.front().psi_rad, 1.2, 1e-9);
  EXPECT_NEAR(found.front().thrust_share, 0.0, 1e-12);
}

TEST(SteadyMotion, AtRestInWindTheBowLiesToItOrTheStern) {
  Disturbance wind;
  wind.wind_mps = {0.0, 8.0};
  const auto found = steadyHeadings(Eigen::Vector2d::Zero(), -1.0, windyVessel(), wind);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(wrapAngle(found[0].psi_rad + 0.5 * kPi), 0.0, 1e-6);
  EXPECT_NEAR(wrapAngle(found[1].psi_rad - 0.5 * kPi), 0.0, 1e-6);
  EXPECT_NEAR(found[0].thrust_share, 0.5 * 64.0 / 100.0, 1e-6);
  for (const SteadyMotion& motion : found) {
    expectSteady(motion, Eigen::Vector2d::Zero(), windyVessel(), wind);
  }
  const SteadyMotion abeam = steadyOn(0.0, Eigen::Vector2d::Zero(), windyVessel(), wind);
  EXPECT_NEAR(abeam.sway_n, -0.7 * 64.0, 1e-9);
}

TEST(SteadyMotion, OnACourseTheHullGoesCrabwise) {
  const Parameters vessel = windyVessel();
  Disturbance sea;
  sea.wind_mps = {3.0, 4.0};
  sea.current_mps = {0.2, -0.1};
  sea.force_n = {-5.0, 8.0};
  sea.moment_nm = 3.0;
  const Eigen::Vector2d velocity(2.0, 0.0);
  const auto found = steadyHeadings(velocity, 0.0, vessel, sea);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(found.front().psi_rad, -0.1);  // into what pushes to port
  EXPECT_GT(found.front().psi_rad, -0.8);
  expectSteady(found.front(), velocity, vessel, sea);
}

TEST(SteadyMotion, MoreThanTheThrustersHaveLeavesNoMargin) {
  Disturbance sea;
  sea.force_n = {-120.0, 0.0};
  const auto found = steadyHeadings(Eigen::Vector2d::Zero(), 0.0, windyVessel(), sea);
  ASSERT_FALSE(found.empty());
  EXPECT_LT(found.front().margin(), 0.0);
}

}  // namespace
}  // namespace otter_nav::vessel
