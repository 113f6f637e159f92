#include "tracker/wind_corridor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::tracker {
namespace {

constexpr double kEverything = std::numeric_limits<double>::infinity();

// 39 N m, and a wind's moment of 0.33 V^2 at 45 degrees.
vessel::Parameters feelingWind() {
  vessel::Parameters vessel;
  vessel.thrusters.ahead_max_n = vessel.thrusters.astern_max_n = 50.0;
  vessel.thrusters.lever_arm_m = 0.39;
  vessel.manoeuvring.wind_yaw_kg = -0.66;
  return vessel;
}

HeadingCorridor after(const vessel::Parameters& vessel, double mean_mps, double now_mps,
                      double psi_rad) {
  WindCorridor corridor(vessel);
  const Eigen::Vector2d towards = unitVector(0.5);
  for (int k = 0; k < 6000; ++k) {
    corridor.feel(0.01 * k, mean_mps * towards);
  }
  corridor.feel(60.0, now_mps * towards);
  return corridor.about(psi_rad);
}

TEST(WindCorridor, IsWhereAGustLeavesMomentToHoldTheHeading) {
  const double bow = 0.5 - kPi;
  for (const double mean : {9.0, 10.0}) {
    const HeadingCorridor corridor = after(feelingWind(), mean, mean, bow + 0.3);
    EXPECT_NEAR(wrapAngle(corridor.psi_rad - bow), 0.0, 1e-9);
    EXPECT_FALSE(corridor.is_sterns);
    // At its edge a gust by 0.3 of the mean takes nine tenths.
    const double gust_nm = 0.33 * std::pow(1.3 * mean, 2) * std::sin(2.0 * corridor.half_width_rad);
    EXPECT_NEAR(gust_nm, 0.9 * 39.0, 1e-6);
  }
  EXPECT_LT(after(feelingWind(), 10.0, 10.0, bow).half_width_rad,
            after(feelingWind(), 9.0, 9.0, bow).half_width_rad);
}

TEST(WindCorridor, AHarderGustThatBlowsNowCounts) {
  EXPECT_LT(after(feelingWind(), 8.5, 13.0, 0.0).half_width_rad,
            after(feelingWind(), 8.5, 8.5, 0.0).half_width_rad - 0.1);
}

// An estimate begins at nothing.
TEST(WindCorridor, KnowsTheMeanOfTheFirstSecondsToo) {
  WindCorridor corridor(feelingWind());
  const Eigen::Vector2d towards = unitVector(0.5);
  for (int k = 0; k <= 500; ++k) {
    corridor.feel(0.01 * k, std::min(10.0, 0.2 * k) * towards);
  }
  const double lasting = after(feelingWind(), 10.0, 10.0, 0.0).half_width_rad;
  EXPECT_NEAR(corridor.about(0.0).half_width_rad, lasting, 0.2 * lasting);
}

TEST(WindCorridor, SternToTheWindIsAsGood) {
  const HeadingCorridor corridor = after(feelingWind(), 9.0, 9.0, 0.8);
  EXPECT_NEAR(wrapAngle(corridor.psi_rad - 0.5), 0.0, 1e-9);
  EXPECT_TRUE(corridor.is_sterns);
  EXPECT_LT(corridor.half_width_rad, 0.5);
}

TEST(WindCorridor, IsEverythingWhereNoGustTakesTheHeading) {
  EXPECT_EQ(after(feelingWind(), 6.0, 6.0, 0.0).half_width_rad, kEverything);
  EXPECT_EQ(after(feelingWind(), 0.0, 0.0, 0.0).half_width_rad, kEverything);
  vessel::Parameters without = feelingWind();
  without.manoeuvring.wind_yaw_kg = 0.0;
  EXPECT_EQ(after(without, 12.0, 12.0, 0.0).half_width_rad, kEverything);
}

}  // namespace
}  // namespace otter_nav::tracker
