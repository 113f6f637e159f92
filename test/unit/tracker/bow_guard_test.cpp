#include "tracker/bow_guard.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace otter_nav::tracker {
namespace {

constexpr double kPitchStepS = 0.01;

vessel::Thrusters thrusters() {
  vessel::Thrusters t;
  t.ahead_max_n = 100.0;
  t.astern_max_n = 60.0;
  return t;
}

// After two seconds in which the bow comes up to `end_rad` at `rate_radps`.
BowGuard risen(double end_rad, double rate_radps, double begin_s = 0.0) {
  BowGuard guard;
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    const double left_s = kPitchStepS * (kSteps - i);
    guard.add(begin_s + kPitchStepS * i, end_rad - rate_radps * left_s);
  }
  return guard;
}

const vessel::Thrusts kWanted{90.0, 70.0};

TEST(BowGuard, LeavesAHullOnEvenKeelAlone) {
  EXPECT_EQ(risen(0.25, 0.0).cut(kWanted, thrusters()), kWanted);
  EXPECT_EQ(risen(-0.8, 0.0).cut(kWanted, thrusters()), kWanted);
  EXPECT_EQ(BowGuard().cut(kWanted, thrusters()), kWanted);
}

TEST(BowGuard, CutsThePushAndKeepsTheTurn) {
  const vessel::Thrusts half = risen(0.45, 0.0).cut(kWanted, thrusters());
  EXPECT_NEAR(half.sum(), 100.0, 1e-6);
  EXPECT_NEAR(half[0] - half[1], 20.0, 1e-6);
  EXPECT_NEAR(risen(0.6, 0.0).cut(kWanted, thrusters()).sum(), 0.0, 1e-6);
  const vessel::Thrusts astern = risen(0.95, 0.0).cut(kWanted, thrusters());
  EXPECT_NEAR(astern[0], -40.0, 1e-6);
  EXPECT_NEAR(astern[1], -60.0, 1e-6);
}

// The reverse: what is pushed astern presses the bow down.
TEST(BowGuard, CutsThePushAsternOfABowThatGoesDown) {
  const vessel::Thrusts astern{-50.0, -10.0};
  EXPECT_EQ(risen(-0.25, 0.0).cut(astern, thrusters()), astern);
  const vessel::Thrusts harder{-50.0, -40.0};
  EXPECT_EQ(risen(0.8, 0.0).cut(harder, thrusters()), harder);
  const vessel::Thrusts none = risen(-0.6, 0.0).cut(astern, thrusters());
  EXPECT_NEAR(none.sum(), 0.0, 1e-6);
  EXPECT_NEAR(none[1] - none[0], 40.0, 1e-6);
  const vessel::Thrusts ahead = risen(-0.95, 0.0).cut(astern, thrusters());
  EXPECT_NEAR(ahead[0], 60.0, 1e-6);
  EXPECT_NEAR(ahead[1], 100.0, 1e-6);
  EXPECT_NEAR(risen(-0.15, -1.0).cut({-60.0, -60.0}, thrusters()).sum(), -60.0, 1e-3);
}

// What rises is cut before it is high, what comes down is not any more.
TEST(BowGuard, SeesWhereTheBowWillBe) {
  EXPECT_NEAR(risen(0.15, 1.0).cut(kWanted, thrusters()).sum(), 100.0, 1e-3);
  EXPECT_EQ(risen(0.45, -1.0).cut(kWanted, thrusters()), kWanted);
}

TEST(BowGuard, StandsGapsStepsBackAndWhatIsNotANumber) {
  BowGuard guard = risen(0.0, 0.0, 50.0);
  guard.add(57.0, 0.45);  // a rate over the gap would be next to nothing, one over a step a jump
  EXPECT_NEAR(guard.cut(kWanted, thrusters()).sum(), 100.0, 1e-6);
  guard.add(1.0, 0.45);
  EXPECT_NEAR(guard.cut(kWanted, thrusters()).sum(), 100.0, 1e-6);
  guard.add(1.0 + kPitchStepS, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(guard.cut(kWanted, thrusters()).allFinite());
}

}  // namespace
}  // namespace otter_nav::tracker
