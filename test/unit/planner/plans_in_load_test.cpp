// Plans of the Otter's manoeuvring model from rest to rest, bow to a load that no thruster holds
// from abeam, to all sides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/planner/planner.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/rest.hpp"
#include "planner_ground.hpp"

namespace otter_nav::planner {
namespace {

constexpr int kCourses = 16;
constexpr double kWayM = 35.0;

vessel::Parameters otter() {
  return *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
}

// The farthest that a hull is from the plan within a second, sailed by its thrusts from outside and
// set on it again each second. Thrusters with a lag are told what to do that much ahead.
double farthestOff(const trajectory::MotionAlong& motion, double duration_s,
                   const vessel::Parameters& vessel, const vessel::Disturbance& load,
                   double lag_s) {
  constexpr double kStepS = 5e-3;
  constexpr double kAnewS = 1.0;
  double farthest = 0.0;
  vessel::State x = vessel::State::Zero();
  vessel::Thrusts thrusts = motion.sample(0.0).thrusts;
  for (int k = 0; k * kStepS + kStepS <= duration_s; ++k) {
    const double t = k * kStepS;
    if (k % static_cast<int>(kAnewS / kStepS) == 0) {
      x = motion.sample(t).state;
    }
    const double tells = std::min(t + 0.5 * kStepS + lag_s, duration_s);
    const vessel::Thrusts told = motion.sample(tells).thrusts;
    const double keeps = lag_s > 0.0 ? std::exp(-kStepS / lag_s) : 0.0;
    thrusts = told + keeps * (thrusts - told);
    const auto slope = [&](const vessel::State& state) {
      return vessel::stateDerivative(state, thrusts, vessel.manoeuvring, vessel.thrusters, load);
    };
    x += kStepS * slope(x + 0.5 * kStepS * slope(x));
    farthest = std::max(farthest, (x.head<2>() - motion.sample(t + kStepS).flat.position).norm());
  }
  return farthest;
}

class PlansInLoadTest : public ::testing::TestWithParam<double> {};

TEST_P(PlansInLoadTest, LeadEverywhereAndTheHullCanFollow) {
  const vessel::Parameters vessel = otter();
  vessel::Disturbance load;
  load.force_n = {GetParam(), 0.0};
  ASSERT_TRUE(vessel::isFirmLoad(vessel, load));
  const map::DistanceField field = test::openWater();
  const feasibility::Obstacles obstacles(field);
  Planner planner(Options{}, vessel);
  Termination termination;
  int solved = 0;
  for (int k = 0; k < kCourses; ++k) {
    const double course = k * 2.0 * kPi / kCourses;
    Query query;
    query.limits = feasibility::SafetyLimits::of(vessel, 1.0, 0.85);
    query.limits.speed_max_mps = 1.5;
    query.limits.disturbance = load;
    query.start.psi_rad = query.goal.psi_rad = kPi;
    query.goal.flat.position = kWayM * Eigen::Vector2d(std::cos(course), std::sin(course));
    const Plan plan = planner.plan(obstacles, query, termination);
    if (plan.outcome != Outcome::kSolved) {
      continue;
    }
    ++solved;
    const trajectory::MotionAlong motion(plan.trajectory, vessel, load, kPi);
    const double duration = plan.trajectory.duration();
    EXPECT_LT(farthestOff(motion, duration, vessel, load, 0.0), 0.01) << "course " << course;
    EXPECT_LT(farthestOff(motion, duration, vessel, load, vessel.thrusters.lag_s), 0.01)
        << "course " << course;
    for (const trajectory::MotionAlong::Point& p : motion.points()) {
      ASSERT_LE(p.thrusts.maxCoeff(), vessel.thrusters.ahead_max_n) << "course " << course;
      ASSERT_GE(p.thrusts.minCoeff(), -vessel.thrusters.astern_max_n) << "course " << course;
    }
    // Bow to the load at both ends; to windward without a turn on the spot.
    EXPECT_NEAR(wrapAngle(motion.psi(duration) - kPi), 0.0, 0.08);
    if (std::cos(course) < -0.1) {
      EXPECT_EQ(plan.trajectory.pieces().front().kind, trajectory::PieceKind::kSail);
    }
    EXPECT_EQ(plan.trajectory.pieces().back().kind, trajectory::PieceKind::kSail);
  }
  EXPECT_GE(solved, kCourses - 1);
}

INSTANTIATE_TEST_SUITE_P(Loads, PlansInLoadTest, ::testing::Values(24.0, 40.0, 60.0));

// Plans have no lag of the thrusters. Where their forces step, at launches and in front of the
// goal, it leaves one or two hundredths of a metre in a second.
TEST(PlansInStillWater, AreFollowedByThrustersThatLag) {
  const vessel::Parameters vessel = otter();
  ASSERT_GT(vessel.thrusters.lag_s, 0.0);
  const map::DistanceField field = test::withObstacle(-3.0, -3.0, 6.0, 6.0);
  const feasibility::Obstacles obstacles(field);
  Planner planner(Options{}, vessel);
  Termination termination;
  for (int k = 0; k < kCourses; ++k) {
    const double course = k * 2.0 * kPi / kCourses;
    Query query;
    query.limits = feasibility::SafetyLimits::of(vessel, 1.0, 0.85);
    query.start.flat.position = -0.5 * kWayM * Eigen::Vector2d(std::cos(course), std::sin(course));
    query.goal.flat.position = -query.start.flat.position;
    query.start.psi_rad = wrapAngle(3.0 * course);
    query.goal.psi_rad = wrapAngle(5.0 * course);
    const Plan plan = planner.plan(obstacles, query, termination);
    ASSERT_EQ(plan.outcome, Outcome::kSolved) << "course " << course;
    const trajectory::MotionAlong motion(plan.trajectory, vessel, {}, query.start.psi_rad);
    const double duration = plan.trajectory.duration();
    EXPECT_LT(farthestOff(motion, duration, vessel, {}, 0.0), 0.01) << "course " << course;
    EXPECT_LT(farthestOff(motion, duration, vessel, {}, vessel.thrusters.lag_s), 0.03)
        << "course " << course;
  }
}

}  // namespace
}  // namespace otter_nav::planner
