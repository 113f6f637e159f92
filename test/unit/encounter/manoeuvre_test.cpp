#include "encounter/manoeuvre.hpp"

#include <gtest/gtest.h>

#include "open_water.hpp"
#include "otter_nav/feasibility/verifier.hpp"

namespace otter_nav::encounter {
namespace {

vessel::Parameters otter() {
  return *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) +
                                 "/config/vessels/otter_gazebo.yaml");
}

vessel::FlatPoint underWay() {
  vessel::FlatPoint start;
  start.velocity = {0.0, 2.0};
  start.acceleration = {0.1, -0.1};
  start.jerk = {0.05, 0.0};
  return start;
}

TEST(Manoeuvre, TurnsAndSlowsAsTheHullCan) {
  const vessel::Parameters vessel = otter();
  const Handling handling(vessel, 2.0);
  const Eigen::Vector2d aside(1.2, 1.6);
  const Eigen::Vector2d slow(0.0, 0.9);
  const double turn = handling.changeDuration({0.0, 2.0}, aside);
  const double brake = handling.changeDuration(aside, slow);
  const trajectory::Trajectory path =
      steer(underWay(), {{0.5 * turn, turn, aside}, {20.0, brake, slow}}, 40.0);
  EXPECT_NEAR(path.duration(), 40.0, 1e-9);
  EXPECT_NEAR((path.flat(40.0).velocity - slow).norm(), 0.0, 1e-9);
  EXPECT_NEAR((path.flat(12.0).velocity - aside).norm(), 0.0, 1e-9);
  const map::DistanceField water = test::openWater();
  const feasibility::Verification verification =
      feasibility::verify(path, water, vessel, feasibility::SafetyLimits::of(vessel));
  EXPECT_TRUE(verification.ok) << verification.reason;
}

TEST(Manoeuvre, BeginsAsWhatIsSailed) {
  const vessel::FlatPoint start = underWay();
  const trajectory::Trajectory path = steer(start, {{5.0, 4.0, {2.0, 0.0}}}, 10.0);
  const vessel::FlatPoint z = path.flat(0.0);
  EXPECT_NEAR((z.velocity - start.velocity).norm(), 0.0, 1e-9);
  EXPECT_NEAR((z.acceleration - start.acceleration).norm(), 0.0, 1e-9);
  EXPECT_NEAR((z.jerk - start.jerk).norm(), 0.0, 1e-9);
}

TEST(Manoeuvre, SlowingDownKeepsTheWayAndItsEnd) {
  const trajectory::Trajectory sailed = steer(underWay(), {{30.0, 6.0, {1.6, 1.2}}}, 60.0);
  const trajectory::Trajectory slow = slowDown(sailed, 10.0, 0.5, 12.0, 4.0, 0.9);
  EXPECT_TRUE(slowDown(sailed, 10.0, 0.5, 12.0, 4.0, 1.1).empty());
  // Half the speed for 12 s and two changes of 4 s: 8 s later.
  EXPECT_NEAR(slow.duration(), 50.0 + 8.0, 1e-6);
  EXPECT_NEAR((slow.flat(slow.duration()).position - sailed.flat(60.0).position).norm(), 0.0, 1e-6);
  EXPECT_NEAR((slow.flat(10.0).velocity - 0.5 * sailed.flat(17.0).velocity).norm(), 0.0, 1e-3);
  const vessel::Parameters vessel = otter();
  const map::DistanceField water = test::openWater();
  const feasibility::Verification verification =
      feasibility::verify(slow, water, vessel, feasibility::SafetyLimits::of(vessel));
  EXPECT_TRUE(verification.ok) << verification.reason;
}

}  // namespace
}  // namespace otter_nav::encounter
