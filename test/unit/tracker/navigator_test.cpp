#include "tracker/navigator.hpp"

#include <gtest/gtest.h>

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
  sail(7.0, 60.0);
  EXPECT_EQ(foreseenMps(), 0.0);
  sail(20.0, 60.0);
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
  sail(6.0, 60.0);
  const vessel::Disturbance told = navigator.disturbanceEstimate().mean;
  EXPECT_EQ(navigator.disturbance().current_mps, told.current_mps);
  EXPECT_EQ(navigator.disturbance().force_n, told.force_n);
}

}  // namespace
}  // namespace otter_nav::tracker
