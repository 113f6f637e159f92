// Whole missions on a small water: plant, lidar, map, planner, tracker and supervisor.
#include "otter_nav/simulation/closed_loop.hpp"

#include <gtest/gtest.h>

#include "../../unit/mission/waters.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/simulation/monitor.hpp"

namespace otter_nav::simulation {
namespace {

namespace test = mission::test;

const scenario::Mission kAcross = {"local", {{-20.0, 0.0}, 0.0}, {{20.0, 0.0}, 0.0}};

LoopOptions options() {
  auto loaded = loadLoopOptions("otter_gazebo", "paper");
  EXPECT_TRUE(loaded.has_value()) << loaded.error().message;
  loaded->timeout_s = 120.0;
  return *loaded;
}

scenario::MissionResult sail(const Waters& waters, std::uint64_t seed = 1) {
  auto loop = ClosedLoop::create(options(), waters, kAcross, seed);
  EXPECT_TRUE(loop.has_value());
  return run(*loop, {"test", 0, "otter_gazebo", "paper", seed}, 0.1, nullptr, {});
}

TEST(ClosedLoop, ArrivesBehindAChartedIsland) {
  Waters waters{test::openWater(60.0), {}};
  test::block(waters.chart, {-4.0, -5.0}, {4.0, 5.0});
  waters.world = waters.chart;
  const scenario::MissionResult result = sail(waters);
  EXPECT_EQ(result.outcome, scenario::Outcome::kArrived) << result.reason;
  EXPECT_GT(result.min_clearance_m, 0.2);
  EXPECT_GT(result.distance_m, 41.0);
  EXPECT_LT(result.tracking_error_max_m, 1.0);
}

TEST(ClosedLoop, ReplansAroundWhatIsNotCharted) {
  Waters waters{test::openWater(60.0), {}};
  waters.world = waters.chart;
  test::block(waters.world, {8.0, -7.0}, {9.0, 7.0});  // beyond the lidar's reach at first
  const scenario::MissionResult result = sail(waters);
  EXPECT_EQ(result.outcome, scenario::Outcome::kArrived) << result.reason;
  EXPECT_GE(result.replans, 1);
  EXPECT_GT(result.min_clearance_m, 0.1);
}

TEST(ClosedLoop, StopsSafelyAndSaysWhyWhenTheGoalIsWalledOff) {
  Waters waters{test::openWater(60.0), {}};
  waters.world = waters.chart;
  test::block(waters.world, {8.0, -29.9}, {9.0, 29.9});
  auto loop = ClosedLoop::create(options(), waters, kAcross, 1);
  ASSERT_TRUE(loop.has_value());
  const scenario::MissionResult result = run(*loop, {}, 0.1, nullptr, {});
  EXPECT_EQ(result.outcome, scenario::Outcome::kStopped);
  EXPECT_NE(result.reason.find("no plan"), std::string::npos) << result.reason;
  EXPECT_GT(result.min_clearance_m, 0.0);
  EXPECT_LT(loop->motion().state.segment<2>(vessel::kSurge).norm(), 0.5);
}

// Nobody can get out of the way of a vessel this broad and fast.
Waters withAVesselInTheWay() {
  Waters waters{test::openWater(60.0), {}, {}};
  waters.world = waters.chart;
  waters.vessels = {{7, {10.0, 100.0}, true, {{-20.0, 30.0}, {-20.0, -200.0}}, {8.0}}};
  return waters;
}

TEST(ClosedLoop, ContactWithAVesselEndsTheMissionAndNamesHer) {
  const scenario::MissionResult result = sail(withAVesselInTheWay());
  EXPECT_EQ(result.outcome, scenario::Outcome::kCollided);
  EXPECT_NE(result.reason.find("vessel 7"), std::string::npos) << result.reason;
  EXPECT_LT(result.min_clearance_m, 0.6);
}

TEST(ClosedLoop, TheMonitorSeesContactAndWhereItWasFirst) {
  const Waters waters = withAVesselInTheWay();
  auto loop = ClosedLoop::create(options(), waters, kAcross, 1);
  ASSERT_TRUE(loop.has_value());
  Monitor monitor(waters, options());
  bool goes_on = true;
  while (goes_on) {
    goes_on = loop->step();
    monitor.watch(*loop);
  }
  EXPECT_EQ(monitor.result().margin_m, 0.0);
  EXPECT_GT(monitor.result().violations, 0);
  EXPECT_NE(monitor.result().first.find("contact"), std::string::npos) << monitor.result().first;
}

// In a sea that throws her over the mission is neither sailed on nor counted as arrived.
TEST(ClosedLoop, ACapsizedVesselHasNotArrived) {
  Waters waters{test::openWater(60.0), {}};
  waters.world = waters.chart;
  LoopOptions steep = options();
  steep.plant.disturbance.waves.components = {{1.5, 2.5, kPi}};
  auto loop = ClosedLoop::create(steep, waters, kAcross, 1);
  ASSERT_TRUE(loop.has_value());
  const scenario::MissionResult result = run(*loop, {}, 0.1, nullptr, {});
  EXPECT_EQ(result.outcome, scenario::Outcome::kCapsized) << result.reason;
}

// The chart ends at x = -30 m, the water goes on.
TEST(ClosedLoop, ComesBackFromOverTheChartsEdge) {
  const Waters waters{test::openWater(60.0), test::openWater(100.0)};
  const scenario::Mission inwards = {"local", {{-32.0, 3.0}, 1.2}, {{20.0, 0.0}, 0.0}};
  auto loop = ClosedLoop::create(options(), waters, inwards, 1);
  ASSERT_TRUE(loop.has_value());
  // After the first second, in which it gets to know the weather.
  while (loop->time() < 1.5 && loop->supervisor().phase() != mission::Phase::kTurningBack) {
    ASSERT_TRUE(loop->step());
  }
  EXPECT_EQ(loop->supervisor().phase(), mission::Phase::kTurningBack);
  const scenario::MissionResult result = run(*loop, {}, 0.1, nullptr, {});
  EXPECT_EQ(result.outcome, scenario::Outcome::kArrived) << result.reason;
  EXPECT_LT(result.duration_s, 60.0);
}

TEST(ClosedLoop, IsTheSameEveryTime) {
  Waters waters{test::openWater(60.0), {}};
  test::block(waters.chart, {-4.0, -5.0}, {4.0, 5.0});
  waters.world = waters.chart;
  const scenario::MissionResult a = sail(waters, 3);
  const scenario::MissionResult b = sail(waters, 3);
  EXPECT_EQ(a.duration_s, b.duration_s);
  EXPECT_EQ(a.distance_m, b.distance_m);
  EXPECT_EQ(a.tracking_error_max_m, b.tracking_error_max_m);
}

}  // namespace
}  // namespace otter_nav::simulation
