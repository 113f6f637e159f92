#include "otter_nav/topology/dubins.hpp"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/DubinsStateSpace.h>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/random.hpp"

namespace otter_nav::topology {
namespace {

Pose randomPose(Random& random, double reach_m) {
  return {{random.uniform(-reach_m, reach_m), random.uniform(-reach_m, reach_m)},
          random.uniform(-kPi, kPi)};
}

TEST(DubinsProperty, LeadsToTheGoalWithinTheRadius) {
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const double radius = random.uniform(0.5, 5.0);
    const double reach = i % 2 == 0 ? 50.0 : 5.0;
    const Pose start = randomPose(random, reach);
    const Pose goal = randomPose(random, reach);
    const DubinsCurve curve(start, goal, radius);
    const Pose end = curve.at(curve.length());
    ASSERT_NEAR((end.position - goal.position).norm(), 0.0, 1e-6) << i;
    ASSERT_NEAR(wrapAngle(end.psi_rad - goal.psi_rad), 0.0, 1e-6) << i;
    ASSERT_GE(curve.length(), (goal.position - start.position).norm() - 1e-9);
    // Unit speed along the heading, and no sharper than the radius.
    const double s = random.uniform(0.0, curve.length() - 1e-4);
    const Pose a = curve.at(s);
    const Pose b = curve.at(s + 1e-4);
    const Eigen::Vector2d ahead(std::cos(a.psi_rad), std::sin(a.psi_rad));
    ASSERT_NEAR((b.position - a.position).dot(ahead), 1e-4, 1e-7);
    ASSERT_LE(std::abs(wrapAngle(b.psi_rad - a.psi_rad)), 1e-4 / radius + 1e-9);
  }
}

TEST(DubinsProperty, IsAsLongAsOmplSays) {
  namespace ob = ompl::base;
  Random random(2);
  const double radius = 3.0;
  auto space = std::make_shared<ob::DubinsStateSpace>(radius);
  ob::RealVectorBounds bounds(2);
  bounds.setLow(-100.0);
  bounds.setHigh(100.0);
  space->setBounds(bounds);
  ob::ScopedState<ob::DubinsStateSpace> from(space);
  ob::ScopedState<ob::DubinsStateSpace> to(space);
  for (int i = 0; i < 500; ++i) {
    const double reach = i % 2 == 0 ? 60.0 : 6.0;
    const Pose start = randomPose(random, reach);
    const Pose goal = randomPose(random, reach);
    from->setXY(start.position.x(), start.position.y());
    from->setYaw(start.psi_rad);
    to->setXY(goal.position.x(), goal.position.y());
    to->setYaw(goal.psi_rad);
    const double length = DubinsCurve(start, goal, radius).length();
    ASSERT_NEAR(length, space->distance(from.get(), to.get()), 1e-4) << i;
  }
}

}  // namespace
}  // namespace otter_nav::topology
