// The tracker against the plant at the ends of trajectories: starts, takeovers, station keeping.
#include "otter_nav/base/angles.hpp"
#include "vessel_at_sea.hpp"

namespace otter_nav::tracker {
namespace {

using test::Stretch;
using test::VesselAtSea;

double thrustRateLimit() {
  return config::load<Options>(test::kSource + "/config/tracker.yaml")->thrust_rate_nps;
}

// The trajectory is 3 s old and the vessel at rest at its start.
TEST(Handover, LateStartCatchesUpWithoutThrustShocks) {
  VesselAtSea sea("paper");
  ASSERT_TRUE(
      sea.tracker().setTrajectory({VesselAtSea::eastward(0.0, 2.0, 90.0), sea.now() - 3.0}));
  const Stretch start = sea.sail(30.0);
  EXPECT_LE(start.max_thrust_rate_nps, thrustRateLimit() * 1.001);
  EXPECT_LT((sea.truth().head<2>() - Eigen::Vector2d(2.0 * 33.0, 0.0)).norm(), 0.1);
  EXPECT_LT(sea.sail(5.0).max_thrust_step_n, 2.0);
}

TEST(Handover, OffsetIsJoinedAlongACurve) {
  VesselAtSea sea("none");
  sea.plant().placeAt({0.0, -8.0}, 0.0);
  ASSERT_TRUE(sea.tracker().setTrajectory({VesselAtSea::eastward(0.0, 1.5, 90.0), sea.now()}));
  double overshoot = 0.0;
  for (int i = 0; i < 40; ++i) {
    const Stretch stretch = sea.sail(1.0);
    EXPECT_LE(stretch.max_thrust_rate_nps, thrustRateLimit() * 1.001);
    overshoot = std::max(overshoot, sea.truth()[1]);
  }
  EXPECT_NEAR(sea.truth()[1], 0.0, 0.05);
  EXPECT_LT(overshoot, 0.3);
}

// 0.3 m abeam of a path at 1.5 m/s. What a heading's error weighs goes with how quickly the hull
// turns: one that turns quickly is soon on the path, one that turns slowly does not cross it.
TEST(Handover, ASmallOffsetIsMadeGoodAsQuicklyAsTheHullTurns) {
  for (const char* name : {"otter_gazebo", "otter"}) {
    VesselAtSea sea("none", 0.0, name);
    ASSERT_TRUE(sea.tracker().setTrajectory({VesselAtSea::eastward(0.0, 1.5, 60.0), sea.now()}));
    sea.sail(20.0);
    const double north_m = sea.truth()[1] + 0.3;
    ASSERT_TRUE(sea.tracker().setTrajectory(
        {VesselAtSea::eastward(1.5 * sea.now(), 1.5, 40.0, north_m), sea.now()}));
    sea.sail(2.5);
    EXPECT_NEAR(sea.truth()[1], north_m, name == std::string("otter") ? 0.08 : 0.05) << name;
    double beyond_m = 0.0;
    for (int i = 0; i < 50; ++i) {
      sea.sail(0.1);
      beyond_m = std::max(beyond_m, sea.truth()[1] - north_m);
    }
    EXPECT_LT(beyond_m, name == std::string("otter") ? 0.002 : 0.01) << name;
  }
}

// The second trajectory is the rest of the first, given anew from a later instant.
TEST(Handover, ATakeoverOnTheSameWayIsSeamless) {
  VesselAtSea sea("paper");
  ASSERT_TRUE(sea.tracker().setTrajectory({VesselAtSea::eastward(0.0, 2.0, 60.0), sea.now()}));
  sea.sail(20.0);
  const Stretch before = sea.sail(2.0);
  const double later = sea.now() + 0.5;
  ASSERT_TRUE(sea.tracker().setTrajectory({VesselAtSea::eastward(2.0 * later, 2.0, 60.0), later}));
  const Stretch across = sea.sail(2.0);
  EXPECT_EQ(across.last.mode, Mode::kTracking);
  EXPECT_LT(across.max_error_m, before.max_error_m + 0.01);
  EXPECT_LT(across.max_thrust_step_n, before.max_thrust_step_n + 1.0);
}

// Before its first trajectory too, and at once.
TEST(Handover, HoldsThePlaceAndTheHeadingThatItIsOn) {
  for (const double psi_rad : {-2.5, 1.6, 3.0}) {
    VesselAtSea sea("none");
    sea.plant().placeAt({3.0, -2.0}, psi_rad);
    sea.tracker().requestStop("nothing to do yet", sea.now(), 1);
    for (int i = 0; i < 40; ++i) {
      sea.sail(0.1);
      ASSERT_NEAR(wrapAngle(sea.truth()[vessel::kPsi] - psi_rad), 0.0, 0.01) << sea.now();
    }
    EXPECT_LT((sea.truth().head<2>() - Eigen::Vector2d(3.0, -2.0)).norm(), 0.02);
  }
}

TEST(Handover, HoldsTheGoalAndItsHeadingInALightWind) {
  VesselAtSea sea("none");
  ASSERT_TRUE(
      sea.tracker().setTrajectory({VesselAtSea::line({0.0, 0.0}, {20.0, 0.0}, 20.0), sea.now()}));
  sea.sail(40.0);
  const Stretch held = sea.sail(20.0);
  EXPECT_EQ(held.last.mode, Mode::kHolding);
  EXPECT_TRUE(held.last.at_goal);
  EXPECT_LT((sea.truth().head<2>() - Eigen::Vector2d(20.0, 0.0)).norm(), 0.3);
  EXPECT_LT(std::abs(sea.truth()[vessel::kPsi]), 0.1);
}

// The plan of the next seconds holds the spot, with what wind and waves leave.
TEST(Handover, HoldsTheSpotInTheWeatherOfThePaper) {
  for (const auto& [vessel, most_m] : {std::pair{"otter_gazebo", 0.15}, std::pair{"otter", 0.2}}) {
    double squares = 0.0;
    int seconds = 0;
    for (const double course : {1.3, 2.6, 3.9, 5.2}) {
      VesselAtSea sea("paper", 0.0, vessel);
      const Eigen::Vector2d goal(15.0 * std::cos(course), 15.0 * std::sin(course));
      sea.plant().placeAt({0.0, 0.0}, course);
      ASSERT_TRUE(
          sea.tracker().setTrajectory({VesselAtSea::line({0.0, 0.0}, goal, 25.0), sea.now()}));
      sea.sail(40.0);
      for (int i = 0; i < 100; ++i, ++seconds) {
        EXPECT_EQ(sea.sail(1.0).last.mode, Mode::kHolding);
        squares += (sea.truth().head<2>() - goal).squaredNorm();
      }
    }
    EXPECT_LT(std::sqrt(squares / seconds), most_m) << vessel;
  }
}

// At crawling pace a hull without a side thruster could only swing against waves from abeam.
TEST(Handover, CrawlsWithoutSwingingAgainstTheWaves) {
  constexpr double kSpeedMps = 0.6;
  constexpr double kDurationS = 130.0;
  VesselAtSea sea("paper", 0.0, "otter");
  sea.plant().placeAt({0.0, 0.0}, 0.5 * kPi);
  vessel::FlatPoint start;
  vessel::FlatPoint end;
  start.velocity = end.velocity = {0.0, kSpeedMps};
  end.position = {0.0, kSpeedMps * kDurationS};
  ASSERT_TRUE(sea.tracker().setTrajectory(
      {trajectory::Trajectory({trajectory::hermitePiece(start, end, kDurationS)}), sea.now()}));
  sea.sail(20.0);
  double headings = 0.0;
  double corners = 0.0;  // the farthest one's distance beside the way
  constexpr int kTimes = 400;
  for (int i = 0; i < kTimes; ++i) {
    sea.sail(0.25);
    const double off = sea.truth()[vessel::kPsi] - 0.5 * kPi;
    headings += off * off / kTimes;
    corners += std::pow(std::abs(sea.truth()[0]) + std::abs(std::sin(off)), 2) / kTimes;
  }
  EXPECT_LT(std::sqrt(headings), 0.08);
  EXPECT_LT(std::sqrt(corners), 0.16);
}

// Along its heading a hull has thrusters: what waves from ahead do there is made good at any pace.
TEST(Handover, MakesGoodWhatWavesDoAlongTheHeading) {
  constexpr double kSpeedMps = 0.4;
  constexpr double kDurationS = 130.0;
  VesselAtSea sea("paper", 0.0, "otter");
  sea.plant().placeAt({0.0, 0.0}, 0.0);
  vessel::FlatPoint start;
  vessel::FlatPoint end;
  start.velocity = end.velocity = {kSpeedMps, 0.0};
  end.position = {kSpeedMps * kDurationS, 0.0};
  const double begins_s = sea.now();
  ASSERT_TRUE(sea.tracker().setTrajectory(
      {trajectory::Trajectory({trajectory::hermitePiece(start, end, kDurationS)}), begins_s}));
  sea.sail(20.0);
  double squares = 0.0;
  constexpr int kTimes = 400;
  for (int i = 0; i < kTimes; ++i) {
    sea.sail(0.25);
    squares += std::pow(sea.truth()[0] - kSpeedMps * (sea.now() - begins_s), 2) / kTimes;
  }
  EXPECT_LT(std::sqrt(squares), 0.04);
}

// A fresh wind on the beam: the hull cannot push sideways, so it turns along the load.
TEST(Handover, WeathervanesWhereTheHeadingCannotBeHeld) {
  VesselAtSea sea("hard");
  ASSERT_TRUE(
      sea.tracker().setTrajectory({VesselAtSea::line({0.0, 0.0}, {-14.0, 14.0}, 25.0), sea.now()}));
  sea.sail(60.0);
  double farthest = 0.0;
  std::string_view reason;
  for (int i = 0; i < 60; ++i) {
    const Stretch held = sea.sail(1.0);
    ASSERT_EQ(held.last.mode, Mode::kHolding);
    reason = held.last.reason;
    farthest = std::max(farthest, (sea.truth().head<2>() - Eigen::Vector2d(-14.0, 14.0)).norm());
  }
  EXPECT_EQ(reason, "the heading yields to the position");
  EXPECT_LT(farthest, 3.0);
}

}  // namespace
}  // namespace otter_nav::tracker
