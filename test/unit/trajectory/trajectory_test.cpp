#include "otter_nav/trajectory/trajectory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/rk4.hpp"
#include "otter_nav/trajectory/joint.hpp"
#include "otter_nav/trajectory/motion_along.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"
#include "otter_nav/vessel/model.hpp"

namespace otter_nav::trajectory {
namespace {

using vessel::FlatPoint;

FlatPoint eight(double t) {
  const double w = 0.06;
  const double a = 50.0;
  const double b = 25.0;
  const double s1 = std::sin(w * t), c1 = std::cos(w * t);
  const double s2 = std::sin(2 * w * t), c2 = std::cos(2 * w * t);
  FlatPoint z;
  z.position = {a * s1, b * s2};
  z.velocity = {a * w * c1, 2 * w * b * c2};
  z.acceleration = {-a * w * w * s1, -4 * w * w * b * s2};
  z.jerk = {-a * w * w * w * c1, -8 * w * w * w * b * c2};
  return z;
}

Trajectory eightTrajectory() {
  std::vector<Piece> pieces;
  for (int k = 0; k < 50; ++k) pieces.push_back(hermitePiece(eight(k), eight(k + 1), 1.0));
  return Trajectory(std::move(pieces));
}

TEST(HermitePiece, MeetsBothEnds) {
  const Piece piece = hermitePiece(eight(0.3), eight(2.8), 2.5);
  for (const double t : {0.0, 2.5}) {
    const FlatPoint z = piece.flat(t);
    const FlatPoint expected = eight(0.3 + t);
    EXPECT_TRUE(z.position.isApprox(expected.position, 1e-10));
    EXPECT_TRUE(z.velocity.isApprox(expected.velocity, 1e-10));
    EXPECT_TRUE(z.acceleration.isApprox(expected.acceleration, 1e-9));
    EXPECT_TRUE(z.jerk.isApprox(expected.jerk, 1e-7));
  }
}

// A swinging way in pieces of all lengths, beside one followed in steps so small that their order
// doesn't matter; from the first step on.
TEST(MotionAlong, FollowsTheHeadingAsStepsFortyTimesFinerDo) {
  const auto otter =
      vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
  ASSERT_TRUE(otter);
  const auto swinging = [](double t) {
    constexpr double w = 0.7;
    FlatPoint z;
    z.position = {1.5 * t, 1.2 * std::sin(w * t)};
    z.velocity = {1.5, 1.2 * w * std::cos(w * t)};
    z.acceleration = {0.0, -1.2 * w * w * std::sin(w * t)};
    z.jerk = {0.0, -1.2 * w * w * w * std::cos(w * t)};
    return z;
  };
  vessel::Disturbance load;
  load.force_n = {4.0, -6.0};
  load.current_mps = {0.1, 0.2};
  constexpr double kFineS = 1e-3;
  const auto fine = [&](const FlatPoint& z, double psi) {
    return vessel::swayHeading(*otter, load, z.velocity, z.acceleration, psi, psi, kFineS).psi_rad;
  };
  constexpr double kStartS = 5.0;
  double psi = 0.0;
  for (int k = 1; k * kFineS <= kStartS; ++k) {
    psi = fine(swinging(k * kFineS), psi);
  }
  std::vector<Piece> pieces;
  double end_s = kStartS;
  for (int k = 0; end_s < 25.0; ++k) {
    const double duration_s = 0.15 + 0.4 * (k % 4);
    pieces.push_back(hermitePiece(swinging(end_s), swinging(end_s + duration_s), duration_s));
    end_s += duration_s;
  }
  const Trajectory trajectory(std::move(pieces));
  const MotionAlong motion(trajectory, *otter, load, psi);
  double farthest = 0.0;
  double rate_off = 0.0;
  std::vector<double> rates;
  for (int k = 1; k * kFineS < trajectory.duration(); ++k) {
    const double before = psi;
    psi = fine(trajectory.flat(k * kFineS), before);
    rates.push_back((psi - before) / kFineS);
    farthest = std::max(farthest, std::abs(psi - motion.psi(k * kFineS)));
    rate_off = std::max(
        rate_off,
        std::abs(rates.back() - motion.sample((k - 0.5) * kFineS).state[vessel::kYawRate]));
  }
  EXPECT_LT(farthest, 2e-4);
  EXPECT_LT(rate_off, 2e-3);
  double acceleration_off = 0.0;
  for (const MotionAlong::Point& point : motion.points()) {
    const auto at = static_cast<std::size_t>(point.t_s / kFineS);
    if (at > 1 && at + 2 < rates.size()) {
      const double acceleration = (rates[at + 1] - rates[at - 1]) / (2.0 * kFineS);
      acceleration_off =
          std::max(acceleration_off, std::abs(point.yaw_acceleration - acceleration));
    }
  }
  EXPECT_LT(acceleration_off, 0.02);
}

// The flat map's inputs drive the model along the flat output: the round trip that makes flatness
// useful. Also in a current.
TEST(Sample, FlatInputsReproduceTheTrajectory) {
  const vessel::Parameters otter;
  const auto model = vessel::ManoeuvringModel::fromPaper(otter.paper);
  for (const Eigen::Vector2d& current : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.3, -0.4)}) {
    const Trajectory trajectory = eightTrajectory();
    vessel::Disturbance water;
    water.current_mps = current;
    vessel::State x = trajectory.sample(0.0, otter, water).state;
    const double dt = 0.005;
    const auto derivative = [&](double t, const vessel::State& s) {
      return vessel::stateDerivative(s, trajectory.sample(t, otter, water).thrusts, model,
                                     otter.thrusters, water);
    };
    for (int k = 0; k < 10000; ++k) x = rk4Step(derivative, k * dt, x, dt);
    const Sample end = trajectory.sample(50.0, otter, water);
    EXPECT_LT((x.head<2>() - end.state.head<2>()).norm(), 1e-3);
    EXPECT_LT(std::abs(wrapAngle(x[vessel::kPsi] - end.state[vessel::kPsi])), 1e-4);
  }
}

TEST(Sample, BrakingPastDragKeepsTheHeading) {
  FlatPoint start;
  FlatPoint end;
  start.velocity = {2.0, 0.0};
  end.position = {2.0, 0.0};
  const Trajectory brake({hermitePiece(start, end, 2.0)});
  for (double t = 0.0; t <= 2.0; t += 0.01) {
    const Sample s = brake.sample(t, vessel::Parameters{});
    EXPECT_NEAR(s.state[vessel::kPsi], 0.0, 1e-9) << t;
    EXPECT_NEAR(s.state[vessel::kYawRate], 0.0, 1e-9) << t;
  }
}

TEST(Sample, SpinTurnsOnTheSpot) {
  const Trajectory spin({spinPiece({1.0, 2.0}, 3.0, 4.0, 2.0)});
  const Sample middle = spin.sample(1.0, vessel::Parameters{});
  EXPECT_NEAR(middle.state[vessel::kPsi], wrapAngle(3.5), 1e-12);
  EXPECT_TRUE(middle.flat.position.isApprox(Eigen::Vector2d(1.0, 2.0)));
  EXPECT_NEAR(middle.tau.surge_n, 0.0, 1e-12);
  EXPECT_NEAR(spin.sample(2.0, vessel::Parameters{}).state[vessel::kYawRate], 0.0, 1e-12);
}

TEST(Joint, GapsAreMeasuredAndTooWideOnesNamed) {
  const std::vector<Piece> whole = eightTrajectory().pieces();
  EXPECT_TRUE(checkPieces(whole, {1e-9, 1e-9}));
  std::vector<Piece> torn = whole;
  torn[2].position(0, 0) += 0.2;
  EXPECT_NEAR(gapBetween(torn[1], torn[2]).position_m, 0.2, 1e-9);
  EXPECT_TRUE(checkPieces(torn, {0.21, 1e-9}));
  EXPECT_NE(checkPieces(torn, {0.19, 1e-9}).error().message.find("pieces[2]"), std::string::npos);
  torn = whole;
  torn[3].position(1, 1) += 0.2;
  EXPECT_NEAR(gapBetween(torn[2], torn[3]).velocity_mps, 0.2, 1e-9);
  EXPECT_NE(checkPieces(torn, {1e-9, 0.19}).error().message.find("velocity"), std::string::npos);
  torn = whole;
  torn[1].duration_s = 0.0;
  EXPECT_FALSE(checkPieces(torn, {1e9, 1e9}));
}

TEST(Length, OfAQuarterCircleLikeEight) {
  double chord = 0.0;
  for (int k = 0; k < 50000; ++k)
    chord += (eight((k + 1) * 1e-3).position - eight(k * 1e-3).position).norm();
  EXPECT_NEAR(length(eightTrajectory()), chord, 1e-4);
}

}  // namespace
}  // namespace otter_nav::trajectory
