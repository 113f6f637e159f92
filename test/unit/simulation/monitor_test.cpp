// Stops that break the rule, and some that keep it.
#include "otter_nav/simulation/monitor.hpp"

#include <gtest/gtest.h>

#include "../mission/waters.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/stopping/braking.hpp"

namespace otter_nav::simulation {
namespace {

namespace test = mission::test;
using trajectory::TimedTrajectory;

constexpr double kSpeed = 2.0;

// A wall 8 m ahead of the origin with a gap to see through nowhere; the chart shows what it is
// told.
Waters waters(map::Cell charted) {
  Waters w;
  w.world = test::openWater();
  test::block(w.world, {8.0, -10.0}, {9.0, 10.0});
  w.chart = test::openWater();
  w.chart.cells.assign(w.chart.cells.size(), charted);
  return w;
}

LoopOptions trusting(bool chart) {
  LoopOptions options;
  options.map.trust_chart = chart;
  return options;
}

// The hull's middle at the origin, bow to the east.
plant::Truth aboard(double pitch_rad = 0.0) {
  plant::Truth truth;
  truth.pitch_rad = pitch_rad;
  return truth;
}

// A rest `length_m` ahead.
TimedTrajectory restAhead(double length_m) {
  return {test::eastward({0.0, 0.0}, length_m, 0.5), 0.0};
}

TEST(Monitor, PassesAStopShortOfTheWall) {
  Monitor monitor(waters(map::Cell::kUnknown), trusting(false));
  monitor.look(aboard());
  EXPECT_EQ(monitor.fault(restAhead(6.5), 0.0), "");
}

TEST(Monitor, FindsAStopThatTouchesWhatWasInSight) {
  Monitor monitor(waters(map::Cell::kFree), trusting(true));
  EXPECT_EQ(monitor.fault(restAhead(7.3), 0.0), "");  // uncharted, and not seen yet
  monitor.look(aboard());
  EXPECT_NE(monitor.fault(restAhead(7.3), 0.0).find("in sight"), std::string::npos);
  EXPECT_EQ(monitor.fault(restAhead(6.9), 0.0), "");
}

// With the bow up the sight lines ahead pass over the wall at 3 m.
TEST(Monitor, LooksAsTheHullIsTilted) {
  constexpr double kBowUpRad = -0.3;
  Monitor monitor(waters(map::Cell::kFree), trusting(true));
  monitor.look(aboard(kBowUpRad));
  EXPECT_EQ(monitor.fault(restAhead(7.3), 0.0), "");
  monitor.look(aboard());
  EXPECT_NE(monitor.fault(restAhead(7.3), 0.0).find("in sight"), std::string::npos);
}

// 5 deg to either side of a post 1 m wide and 10 m off beams pass by 0.4 m.
TEST(Monitor, SeesNothingBetweenTheBeams) {
  Waters w = waters(map::Cell::kFree);
  w.world = test::openWater();
  test::block(w.world, {10.0, -0.5}, {11.0, 0.5});
  LoopOptions options = trusting(true);
  options.plant.lidar.beams = 36;
  Monitor monitor(w, options);
  plant::Truth now = aboard();
  now.yaw_rad = kPi / 36.0;
  monitor.look(now);
  EXPECT_EQ(monitor.fault(restAhead(9.5), 0.0), "");
  monitor.look(aboard());
  EXPECT_NE(monitor.fault(restAhead(9.5), 0.0).find("in sight"), std::string::npos);
}

// One that lies ahead, and one that has gone on by then.
TEST(Monitor, DoesNotLookThroughOtherVessels) {
  Waters w = waters(map::Cell::kFree);
  vessel::ScriptedVessel other;
  other.hull = {12.0, 2.0};
  other.waypoints = {{5.0, 0.0}, {5.0, 60.0}};
  other.speeds_mps = {2.0};
  w.vessels = {other};
  Monitor monitor(w, trusting(true));
  plant::Truth now = aboard();
  monitor.look(now);
  EXPECT_EQ(monitor.fault(restAhead(7.3), 0.0), "");
  now.stamp_s = 20.0;
  monitor.look(now);
  EXPECT_NE(monitor.fault(restAhead(7.3), 0.0).find("in sight"), std::string::npos);
}

TEST(Monitor, FindsAStopInWaterThatNobodySaw) {
  const TimedTrajectory stop = restAhead(4.0);
  Monitor blind(waters(map::Cell::kUnknown), trusting(true));
  EXPECT_NE(blind.fault(stop, 0.0).find("not seen"), std::string::npos);
  Monitor doubting(waters(map::Cell::kFree), trusting(false));
  EXPECT_NE(doubting.fault(stop, 0.0).find("not seen"), std::string::npos);
  doubting.look(aboard());
  EXPECT_EQ(doubting.fault(stop, 0.0), "");
  // Behind the wall nothing was in sight.
  const TimedTrajectory behind{test::eastward({12.0, 0.0}, 6.0, 0.5), 0.0};
  EXPECT_NE(doubting.fault(behind, 0.0).find("not seen"), std::string::npos);
}

// She crosses ahead of us, at right angles, while the stop still makes way.
TEST(Monitor, FindsAStopThatMeetsAnotherVessel) {
  constexpr double kCrossesM = 3.5;
  constexpr double kStartsS = 4.0;
  const double turns_at_m = -5.0;
  for (const bool turns : {false, true}) {
    Waters w = waters(map::Cell::kFree);
    vessel::ScriptedVessel other;
    other.hull = {6.0, 2.0};
    other.waypoints = {{kCrossesM, -20.0}, {kCrossesM, turns_at_m}};
    other.waypoints.emplace_back(turns ? 40.0 : kCrossesM, turns ? turns_at_m : 40.0);
    other.speeds_mps = {2.0};
    w.vessels = {other};
    const TimedTrajectory stop{restAhead(6.5).trajectory, kStartsS};
    Monitor monitor(w, trusting(true));
    plant::Truth now = aboard();
    now.stamp_s = kStartsS;
    monitor.look(now);
    EXPECT_EQ(monitor.fault(stop, kStartsS), "");  // nobody knows her course yet
    Monitor longer(w, trusting(true));
    for (now.stamp_s = 0.0; now.stamp_s <= kStartsS; now.stamp_s += 1.0) {
      longer.look(now);
    }
    EXPECT_NE(longer.fault(stop, kStartsS).find("another vessel"), std::string::npos);
    // At rest she may come over us: that is no fault of the stop.
    EXPECT_EQ(longer.fault({restAhead(1.0).trajectory, kStartsS}, kStartsS), "");
    // Once she has turned it is her new course that counts, when it is known.
    now.stamp_s = 7.6;
    longer.look(now);
    EXPECT_EQ(longer.fault({restAhead(6.5).trajectory, now.stamp_s - 3.0}, now.stamp_s).empty(),
              turns);
  }
}

TEST(Monitor, FindsAStopThatDoesNotEnd) {
  Monitor monitor(waters(map::Cell::kFree), trusting(true));
  const trajectory::Trajectory whole = test::eastward({-40.0, 0.0}, 40.0, kSpeed);
  const TimedTrajectory cut{
      trajectory::Trajectory({whole.pieces().begin(), whole.pieces().end() - 1}), 0.0};
  EXPECT_NE(monitor.fault(cut, 0.0).find("under way"), std::string::npos);
  // What is past doesn't count, and what comes does.
  EXPECT_EQ(monitor.fault({whole, 0.0}, 20.0), "");
}

}  // namespace
}  // namespace otter_nav::simulation
