#include "tracker/navigator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/rk4.hpp"

namespace otter_nav::tracker {
namespace {

// An otter in waves that take it along, fifty odometries a second.
class InWaves : public ::testing::Test {
 protected:
  static vessel::Parameters otter() {
    return *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) +
                                   "/config/vessels/otter.yaml");
  }
  static WaterMotion waterAt(double t) {
    constexpr double kRadps = 2.0;
    const Eigen::Vector2d to_leeward(0.2, 0.1);
    return {std::sin(kRadps * t) * to_leeward, kRadps * std::cos(kRadps * t) * to_leeward};
  }
  void sail(double duration_s, double push_n) {
    const vessel::Thrusts thrusts(push_n, push_n);
    for (int i = 0; i < static_cast<int>(50.0 * duration_s + 0.5); ++i) {
      navigator.addCommand(now_s, thrusts);
      state = rk4Step(
          [&](double t, const vessel::State& x) {
            return derivativeInWater(x, thrusts, vessel, {}, waterAt(t));
          },
          now_s, state, 0.02);
      now_s += 0.02;
      navigator.addOdometry(now_s, state);
    }
  }
  [[nodiscard]] double foreseenMps() const {
    double most = 0.0;
    for (double in_s = 0.0; in_s < 3.0; in_s += 0.1) {
      most = std::max(most, navigator.water(now_s + in_s).velocity_mps.norm());
    }
    return most;
  }

  vessel::Parameters vessel = otter();
  Navigator navigator{Options{}, vessel};
  vessel::State state = vessel::State::Zero();
  double now_s = 0.0;
};

// In the first seconds waves and current can't be told apart, and at rest a hull is left to swing.
TEST_F(InWaves, AreForeseenOnceUnderWayForAWhile) {
  sail(10.0, 0.0);
  EXPECT_EQ(foreseenMps(), 0.0);
  sail(4.0, 60.0);
  EXPECT_EQ(foreseenMps(), 0.0);
  sail(23.0, 60.0);
  EXPECT_GT(foreseenMps(), 0.05);
  state[vessel::kSurge] = 0.0;
  sail(12.0, 0.0);
  EXPECT_EQ(foreseenMps(), 0.0);
}

TEST_F(InWaves, AreForgottenInAGap) {
  sail(30.0, 60.0);
  EXPECT_GT(foreseenMps(), 0.05);
  now_s += 2.0;
  sail(0.04, 60.0);
  EXPECT_EQ(foreseenMps(), 0.0);
}

// The water that the waves move is told as a current at first.
TEST_F(InWaves, ACurrentIsSteeredByOnceItWasFelt) {
  for (const double felt_s : {0.5, 1.0, 2.0, 4.0}) {
    sail(felt_s - now_s, 0.0);
    const Eigen::Vector2d told = navigator.disturbanceEstimate().mean.current_mps;
    const Eigen::Vector2d steered_by = navigator.disturbance().current_mps;
    EXPECT_GT(told.norm(), 0.02) << felt_s;
    EXPECT_NEAR((steered_by - 0.2 * felt_s * told).norm(), 0.0, 0.01 * told.norm()) << felt_s;
  }
}

// As its estimate of the disturbance is then the one that it always had.
TEST_F(InWaves, TellTheMissionWhatTheFirstFilterFinds) {
  sail(3.0, 0.0);
  sail(3.5, 60.0);
  const vessel::Disturbance told = navigator.disturbanceEstimate().mean;
  EXPECT_EQ(navigator.disturbance().current_mps, told.current_mps);
  EXPECT_EQ(navigator.disturbance().force_n, told.force_n);
}

// What comes after a gap says nothing of how long the water was felt.
TEST_F(InWaves, AGapIsNotFelt) {
  sail(1.0, 60.0);
  now_s += 12.0;
  navigator.addOdometry(now_s, state);
  EXPECT_EQ(foreseenMps(), 0.0);
  sail(4.0, 60.0);
  EXPECT_EQ(foreseenMps(), 0.0);
}

// An otter_gazebo in still water, a hundred odometries a second.
class InStillWater : public ::testing::Test {
 protected:
  static vessel::Parameters withLag(double lag_s) {
    vessel::Parameters vessel;
    vessel.thrusters.lag_s = lag_s;
    return vessel;
  }
  [[nodiscard]] vessel::State after(const vessel::State& x, const vessel::Thrusts& thrusts) const {
    return rk4Step(
        [&](double, const vessel::State& y) {
          return derivativeInWater(y, thrusts, vessel, {}, {});
        },
        0.0, x, kPeriodS);
  }
  void sail(double duration_s, const vessel::Thrusts& thrusts) {
    for (int i = 0; i < static_cast<int>(duration_s / kPeriodS + 0.5); ++i) {
      navigator.addCommand(now_s, thrusts);
      state = after(state, thrusts);
      now_s += kPeriodS;
      navigator.addOdometry(now_s, state);
    }
  }

  static constexpr double kPeriodS = 0.01;
  vessel::Parameters vessel = withLag(0.0);
  Navigator navigator{Options{}, vessel};
  vessel::State state = vessel::State::Zero();
  double now_s = 10.0;
};

// All of what was sent counts while the vessel brakes blind, the first of it too.
TEST_F(InStillWater, CommandsAreKnownForAsLongAsTheModelAloneIsSteeredBy) {
  sail(3.0, {10.0, 10.0});
  vessel::State expected = state;
  const double lost_s = now_s;
  while (now_s < lost_s + kBlindS - 0.5 * kPeriodS) {
    const double share = (now_s - lost_s) / kBlindS;
    const vessel::Thrusts thrusts(share < 0.4 ? 30.0 : 0.0, share < 0.4 ? 20.0 : 0.0);
    navigator.addCommand(now_s, thrusts);
    expected = after(expected, thrusts);
    now_s += kPeriodS;
  }
  EXPECT_GT((expected - state).head<2>().norm(), 1.0);
  EXPECT_NEAR((navigator.predict(now_s) - expected).norm(), 0.0, 0.02);
}

// The thrusters turn as they were told last, not as they did before the gap.
TEST_F(InStillWater, ThrustersFollowedTheirCommandsThroughAGap) {
  vessel = withLag(0.3);
  navigator = Navigator(Options{}, vessel);
  sail(3.0, {40.0, 40.0});
  navigator.addCommand(now_s, {0.0, 0.0});
  now_s += 2.0;
  vessel::State rests = vessel::State::Zero();
  navigator.addOdometry(now_s, rests);
  EXPECT_LT(navigator.predict(now_s + 0.3)[vessel::kSurge], 0.1);
}

TEST_F(InStillWater, TheHeadingStaysContinuousThroughGapsAndJumps) {
  const vessel::Thrusts turning(-20.0, 20.0);
  sail(10.0, turning);
  ASSERT_GT(state[vessel::kPsi], 2.0 * kPi);
  const auto wrapped = [&] {
    vessel::State x = state;
    x[vessel::kPsi] = wrapAngle(x[vessel::kPsi]);
    return x;
  };
  now_s += 2.0;
  navigator.addOdometry(now_s, wrapped());
  EXPECT_NEAR(navigator.predict(now_s)[vessel::kPsi], state[vessel::kPsi], 1e-6);
  state[vessel::kX] += 3.0;
  state[vessel::kYawRate] = 0.0;
  for (int i = 0; i < 50; ++i) {
    now_s += kPeriodS;
    navigator.addOdometry(now_s, wrapped());
  }
  EXPECT_NEAR(navigator.predict(now_s)[vessel::kX], state[vessel::kX], 0.01);
  EXPECT_NEAR(navigator.predict(now_s)[vessel::kPsi], state[vessel::kPsi], 0.3);
}

TEST_F(InStillWater, WhatNoVesselDoesIsNeverBelieved) {
  sail(3.0, {20.0, 20.0});
  for (const int row : {vessel::kSurge, vessel::kSway, vessel::kYawRate}) {
    for (const double bad : {100.0, -1e6, 1e300}) {
      vessel::State x = state;
      x[row] = bad;
      for (int i = 0; i < 40; ++i) {
        navigator.addOdometry(now_s + 1e-3 * (i + 1), x);
        EXPECT_EQ(navigator.reason(), "odometry is too fast to be true");
      }
      EXPECT_NEAR((navigator.predict(now_s) - state).norm(), 0.0, 0.05);
      sail(0.1, {20.0, 20.0});
      EXPECT_TRUE(navigator.reason().empty());
    }
  }
}

// A current and a gust may carry a hull along faster than its thrusters could.
TEST_F(InStillWater, WhatCarriesAHullFasterThanItSailsIsBelieved) {
  state[vessel::kSurge] = 2.0 * vessel.top_speed_mps;
  state[vessel::kYawRate] = 4.0;
  sail(0.05, {0.0, 0.0});
  EXPECT_TRUE(navigator.reason().empty());
  EXPECT_NEAR(navigator.predict(now_s)[vessel::kSurge], state[vessel::kSurge], 0.1);
}

TEST_F(InStillWater, BeginsAnewWhereTheEstimateIsNoNumber) {
  sail(1.0, {20.0, 20.0});
  navigator.addCommand(now_s, {0.0, 0.0});
  navigator.replaceCommand(vessel::Thrusts::Constant(std::nan("")));
  now_s += kPeriodS;
  navigator.addOdometry(now_s, state);
  sail(0.2, {20.0, 20.0});
  EXPECT_NEAR((navigator.predict(now_s) - state).norm(), 0.0, 0.05);
  EXPECT_TRUE(navigator.disturbance().force_n.allFinite());
}

}  // namespace
}  // namespace otter_nav::tracker
