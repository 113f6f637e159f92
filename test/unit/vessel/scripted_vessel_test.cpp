// Vessels that sail as they are written.
#include "otter_nav/vessel/scripted_vessel.hpp"

#include <gtest/gtest.h>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::vessel {
namespace {

TEST(ScriptedVessel, HeadsAlongItsLegAndLiesAtTheEnd) {
  const ScriptedVessel vessel{
      1, {6.0, 2.0}, true, {{0.0, 0.0}, {10.0, 0.0}, {10.0, 20.0}}, {2.0, 4.0}};
  const auto at = [&](double t) { return motionAt(vessel, t); };
  EXPECT_EQ(at(-3.0).pose.position, Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(at(2.0).pose.position, Eigen::Vector2d(4.0, 0.0));
  EXPECT_EQ(at(2.0).speed_mps, 2.0);
  EXPECT_EQ(at(4.999).pose.psi_rad, 0.0);
  EXPECT_NEAR(at(5.0).pose.psi_rad, 0.5 * kPi, 1e-12);  // turns at once
  EXPECT_NEAR((at(7.5).pose.position - Eigen::Vector2d(10.0, 10.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(at(7.5).speed_mps, 4.0);
  EXPECT_EQ(at(1000.0).pose.position, Eigen::Vector2d(10.0, 20.0));
  EXPECT_EQ(at(1000.0).speed_mps, 0.0);
  EXPECT_NEAR(at(1000.0).pose.psi_rad, 0.5 * kPi, 1e-12);
}

TEST(ScriptedVessel, OneSpeedIsThatOfAllLegs) {
  const ScriptedVessel vessel{
      1, {6.0, 2.0}, true, {{0.0, 0.0}, {10.0, 0.0}, {10.0, 0.0}, {0.0, 0.0}}, {2.0}};
  EXPECT_NEAR(motionAt(vessel, 7.5).pose.position.x(), 5.0, 1e-12);
  EXPECT_NEAR(motionAt(vessel, 7.5).pose.psi_rad, kPi, 1e-12);
}

}  // namespace
}  // namespace otter_nav::vessel
