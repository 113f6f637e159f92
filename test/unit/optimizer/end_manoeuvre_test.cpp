// Launches and arrivals against the model they come from: integrated afresh under the thrusts that
// the pieces ask for, they must lead where the pieces lead.
#include "optimizer/ends/end_manoeuvre.hpp"

#include <gtest/gtest.h>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/manoeuvring_motion.hpp"
#include "otter_nav/vessel/model.hpp"
#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::optimizer {
namespace {

using trajectory::Trajectory;

const Eigen::Vector2d kPlace(3.0, -2.0);
constexpr double kPsi = 0.7;

vessel::Parameters otterLike() {
  vessel::Parameters vessel;
  vessel.paper = {83.5, 50.0, 78.9, 120.0, 84.8};
  vessel.manoeuvring = vessel::ManoeuvringModel::fromPaper(vessel.paper);
  vessel.thrusters = {0.395, 119.7, 66.7, 0.1};
  return vessel;
}

// The state after the trajectory, integrated by Runge and Kutta's method from its first state.
vessel::State sailed(const Trajectory& trajectory, const vessel::Parameters& vessel) {
  constexpr double kStep = 2e-3;
  const auto model = vessel::ManoeuvringModel::fromPaper(vessel.paper);
  vessel::State x = trajectory.sample(0.0, vessel).state;
  for (std::size_t i = 0; i < trajectory.pieces().size(); ++i) {
    const double duration = trajectory.pieces()[i].duration_s;
    const int steps = std::max(1, static_cast<int>(std::ceil(duration / kStep)));
    const double h = duration / steps;
    const auto slope = [&](double t, const vessel::State& state) {
      return vessel::stateDerivative(state, trajectory.sampleIn(i, t, vessel).thrusts, model,
                                     vessel.thrusters, {});
    };
    for (int k = 0; k < steps; ++k) {
      const double t = h * k;
      const vessel::State k1 = slope(t, x);
      const vessel::State k2 = slope(t + 0.5 * h, x + 0.5 * h * k1);
      const vessel::State k3 = slope(t + 0.5 * h, x + 0.5 * h * k2);
      const vessel::State k4 = slope(t + h, x + h * k3);
      x += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
  }
  return x;
}

void expectSound(const Manoeuvre& manoeuvre, const vessel::Parameters& vessel,
                 const ManoeuvreLimits& limits) {
  const Trajectory trajectory(manoeuvre.pieces);
  EXPECT_NEAR(trajectory.duration(), manoeuvre.duration_s, 1e-9);
  const vessel::State end = sailed(trajectory, vessel);
  const vessel::State planned = trajectory.sample(trajectory.duration(), vessel).state;
  EXPECT_LT((end.head<2>() - planned.head<2>()).norm(), 2e-3);
  EXPECT_LT(std::abs(wrapAngle(end[vessel::kPsi] - planned[vessel::kPsi])), 2e-3);
  EXPECT_LT((end.tail<3>() - planned.tail<3>()).norm(), 5e-3);
  for (std::size_t i = 0; i < manoeuvre.pieces.size(); ++i) {
    const double duration = manoeuvre.pieces[i].duration_s;
    for (int k = 0; k <= 20; ++k) {
      const trajectory::Sample sample = trajectory.sampleIn(i, duration * k / 20, vessel);
      const vessel::Thrusts& thrusts = sample.thrusts;
      // No force from the side: m1 z'' + d2 z' has no part across the bow.
      const Eigen::Vector2d w = vessel.paper.m1_kg * sample.flat.acceleration +
                                vessel.paper.d2_kgps * sample.flat.velocity;
      const double psi = sample.state[vessel::kPsi];
      EXPECT_LT(std::abs(std::cos(psi) * w.y() - std::sin(psi) * w.x()), 0.05);
      EXPECT_LT(thrusts.maxCoeff(), 1.005 * limits.thrust_share * vessel.thrusters.ahead_max_n);
      EXPECT_GT(thrusts.minCoeff(), -1.005 * limits.thrust_share * vessel.thrusters.astern_max_n);
    }
    if (i > 0) {
      const vessel::FlatPoint a = manoeuvre.pieces[i - 1].flat(manoeuvre.pieces[i - 1].duration_s);
      const vessel::FlatPoint b = manoeuvre.pieces[i].flat(0.0);
      EXPECT_LT((a.position - b.position).norm(), 1e-9);
      EXPECT_LT((a.velocity - b.velocity).norm(), 1e-9);
      EXPECT_LT((a.acceleration - b.acceleration).norm(), 1e-8);
      EXPECT_LT((a.jerk - b.jerk).norm(), 1e-7);
    }
  }
}

class EndManoeuvreTest : public ::testing::TestWithParam<double> {};

TEST_P(EndManoeuvreTest, LaunchFollowsTheModelAndTurnsAsFarAsAsked) {
  for (const vessel::Parameters& vessel : {vessel::Parameters(), otterLike()}) {
    for (const bool settle : {false, true}) {
      ManoeuvreLimits limits;
      limits.yaw_rate_max_radps = 1.8;
      limits.settle = settle;
      const Manoeuvre m = launch(kPlace, kPsi, GetParam(), vessel, limits);
      expectSound(m, vessel, limits);
      const Trajectory trajectory(m.pieces);
      const vessel::State first = trajectory.sample(0.0, vessel).state;
      EXPECT_LT((first.head<2>() - kPlace).norm(), 1e-9);
      EXPECT_NEAR(first[vessel::kPsi], kPsi, 1e-9);
      EXPECT_LT(first.tail<3>().norm(), 1e-9);
      const vessel::State last = trajectory.sample(trajectory.duration(), vessel).state;
      EXPECT_GT(m.joint.velocity.norm(), 0.1);
      if (settle) {
        EXPECT_NEAR(wrapAngle(last[vessel::kPsi] - kPsi - GetParam()), 0.0, 1e-6);
      } else {
        // What is left is turned while the yaw rate dies away.
        EXPECT_LE(std::abs(wrapAngle(last[vessel::kPsi] - kPsi)), std::abs(GetParam()) + 1e-6);
        EXPECT_GE(last[vessel::kYawRate] * GetParam(), 0.0);
      }
    }
  }
}

TEST_P(EndManoeuvreTest, ArrivalFollowsTheModelToRestAtTheGoal) {
  for (const vessel::Parameters& vessel : {vessel::Parameters(), otterLike()}) {
    for (const double drift : {0.0, 0.3, 1.0}) {
      ManoeuvreLimits limits;
      limits.yaw_rate_max_radps = 1.8;
      limits.drift_mps = drift;
      const Manoeuvre m = arrival(kPlace, kPsi, GetParam(), 1.8, vessel, limits);
      expectSound(m, vessel, limits);
      const Trajectory trajectory(m.pieces);
      const vessel::State last = trajectory.sample(trajectory.duration(), vessel).state;
      EXPECT_LT((last.head<2>() - kPlace).norm(), 1e-9);
      EXPECT_NEAR(wrapAngle(last[vessel::kPsi] - kPsi), 0.0, 1e-6);
      EXPECT_LT(last.tail<3>().norm(), 1e-6);
      EXPECT_GT(m.joint.velocity.norm(), 1.8);
      const vessel::State first = trajectory.sample(0.0, vessel).state;
      EXPECT_NEAR(wrapAngle(kPsi - first[vessel::kPsi] - GetParam()), 0.0, 1e-6);
      EXPECT_NEAR(first[vessel::kYawRate], 0.0, 1e-9);
    }
  }
}

TEST_P(EndManoeuvreTest, TurningUnderWayIsQuickerThanTurningAtRest) {
  if (std::abs(GetParam()) < 0.1) {
    return;
  }
  const vessel::Parameters vessel;
  ManoeuvreLimits limits;
  limits.yaw_rate_max_radps = 1.8;
  const Manoeuvre loose = launch(kPlace, kPsi, GetParam(), vessel, limits);
  limits.settle = true;
  EXPECT_LT(loose.duration_s, launch(kPlace, kPsi, GetParam(), vessel, limits).duration_s - 0.3);
}

// What the paper's five numbers do not hold: quadratic drag, Munk's moment, sway and yaw coupled.
vessel::Parameters realHull() {
  vessel::Parameters vessel = otterLike();
  vessel::ManoeuvringModel& m = vessel.manoeuvring;
  m.sway_inertia_kg = 65.0;
  m.yaw_inertia_kgm2 = 40.0;
  m.surge_centripetal_kg = 146.0;
  m.sway_centripetal_kg = 39.0;
  m.munk_kg = 68.0;
  m.sway_drag_kgps = 56.0;
  m.yaw_drag_kgm2ps = 31.0;
  m.sway_drag_quadratic_kgpm = 184.0;
  m.yaw_drag_quadratic_kgm2 = 527.0;
  m.sway_from_yaw_kgmps = -9.7;
  m.yaw_from_sway_kgmps = -20.0;
  return vessel;
}

// Integrated from the first state under the thrusts of MotionAlong, with what pushes besides.
void expectSailsUnder(const vessel::Disturbance& disturbance, const Manoeuvre& manoeuvre,
                      const vessel::Parameters& vessel, double psi_rad, double thrust_share) {
  const Trajectory trajectory(manoeuvre.pieces);
  const trajectory::MotionAlong motion(trajectory, vessel, disturbance, psi_rad);
  const vessel::ManoeuvringModel& model = vessel.manoeuvring;
  constexpr double kStep = 2e-3;
  vessel::State x = motion.sample(0.0).state;
  vessel::Thrusts most = vessel::Thrusts::Zero();
  vessel::Thrusts least = vessel::Thrusts::Zero();
  for (double t = 0.0; t < trajectory.duration(); t += kStep) {
    const vessel::Thrusts thrusts = motion.sample(t + 0.5 * kStep).thrusts;
    most = most.cwiseMax(thrusts);
    least = least.cwiseMin(thrusts);
    const double h = std::min(kStep, trajectory.duration() - t);
    const auto slope = [&](const vessel::State& state) {
      return vessel::stateDerivative(state, thrusts, model, vessel.thrusters, disturbance);
    };
    x += h * slope(x + 0.5 * h * slope(x));
  }
  const vessel::State planned = motion.sample(trajectory.duration()).state;
  EXPECT_LT((x.head<2>() - planned.head<2>()).norm(), 0.02);
  EXPECT_LT(std::abs(wrapAngle(x[vessel::kPsi] - planned[vessel::kPsi])), 0.01);
  EXPECT_LT(most.maxCoeff(), 1.03 * thrust_share * vessel.thrusters.ahead_max_n);
  EXPECT_GT(least.minCoeff(), -1.03 * thrust_share * vessel.thrusters.astern_max_n);
}

TEST_P(EndManoeuvreTest, HoldsForARealHullAndUnderLoad) {
  vessel::Disturbance load;
  load.force_n = {5.0, -3.0};
  load.current_mps = {0.05, 0.1};
  load.moment_nm = 2.0;
  vessel::Parameters paper = otterLike();
  for (const vessel::Parameters& vessel : {realHull(), paper}) {
    for (const vessel::Disturbance& disturbance : {vessel::Disturbance(), load}) {
      ManoeuvreLimits limits;
      limits.yaw_rate_max_radps = 1.8;
      limits.drift_mps = 0.0;
      limits.disturbance = disturbance;
      const Manoeuvre out = launch(kPlace, kPsi, GetParam(), vessel, limits);
      if (!vessel::paperHolds(vessel)) {
        expectSailsUnder(disturbance, out, vessel, kPsi, limits.thrust_share);
      }
      const Manoeuvre in = arrival(kPlace, kPsi, GetParam(), 1.2, vessel, limits);
      if (!vessel::paperHolds(vessel)) {
        expectSailsUnder(disturbance, in, vessel, kPsi - GetParam(), limits.thrust_share);
      }
      const Trajectory trajectory(in.pieces);
      const vessel::FlatPoint end = trajectory.flat(trajectory.duration());
      EXPECT_LT((end.position - kPlace).norm(), 1e-9);
      EXPECT_LT(end.velocity.norm(), vessel::paperHolds(vessel) ? 1e-6 : 0.2);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Turns, EndManoeuvreTest,
                         ::testing::Values(0.0, 0.05, 0.5, -0.5, 1.6, -1.6, 3.1));

}  // namespace
}  // namespace otter_nav::optimizer
