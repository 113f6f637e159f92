#include "otter_nav/topology/dubins.hpp"

#include <gtest/gtest.h>

#include "otter_nav/base/angles.hpp"

namespace otter_nav::topology {
namespace {

using Turn = DubinsCurve::Turn;

TEST(DubinsCurve, StraightAhead) {
  const DubinsCurve curve({{1.0, 2.0}, 0.0}, {{11.0, 2.0}, 0.0}, 3.0);
  EXPECT_NEAR(curve.length(), 10.0, 1e-9);
  EXPECT_NEAR((curve.at(4.0).position - Eigen::Vector2d(5.0, 2.0)).norm(), 0.0, 1e-9);
}

TEST(DubinsCurve, HalfTurnToPort) {
  const DubinsCurve curve({{0.0, 0.0}, 0.0}, {{0.0, 6.0}, kPi}, 3.0);
  EXPECT_NEAR(curve.length(), 3.0 * kPi, 1e-9);
  EXPECT_NEAR((curve.at(1.5 * kPi).position - Eigen::Vector2d(3.0, 3.0)).norm(), 0.0, 1e-9);
}

TEST(DubinsCurve, TurningOnTheSpotTakesThreeTurns) {
  const DubinsCurve curve({{0.0, 0.0}, 0.0}, {{0.0, 0.0}, kPi}, 1.0);
  EXPECT_NEAR(curve.length(), 7.0 * kPi / 3.0, 1e-9);
  EXPECT_NE(curve.turns()[1], Turn::kStraight);
}

TEST(DubinsCurve, SamePoseIsNoCurve) {
  const Pose pose{{3.0, -2.0}, 1.0};
  EXPECT_NEAR(DubinsCurve(pose, pose, 3.0).length(), 0.0, 1e-9);
}

TEST(DubinsCurve, EndsAreClamped) {
  const DubinsCurve curve({{0.0, 0.0}, 0.0}, {{5.0, 0.0}, 0.0}, 1.0);
  EXPECT_EQ(curve.at(-1.0).position, Eigen::Vector2d(0.0, 0.0));
  EXPECT_NEAR((curve.at(99.0).position - Eigen::Vector2d(5.0, 0.0)).norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace otter_nav::topology
