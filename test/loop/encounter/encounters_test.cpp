// Whole missions in open water among other vessels that keep their course: we go north at 2 m/s,
// everybody meets after 50 s.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../../unit/mission/waters.hpp"
#include "otter_nav/base/angles.hpp"
#include "otter_nav/simulation/closed_loop.hpp"

namespace otter_nav::simulation {
namespace {

namespace test = mission::test;

struct Sailed {
  scenario::Outcome outcome = scenario::Outcome::kError;
  double centres_m = 1e9;          // the least
  double first_turn_s = 1e9;       // off the way by more than 5 deg, once under way
  double starboard_max_rad = 0.0;  // off the way
  double port_max_rad = 0.0;
  double slowest_mps = 1e9;
  encounter::Role role = encounter::Role::kNone;  // the first
};

// One vessel on a compass heading that meets us in the middle.
Sailed meet(double heading_deg, double speed_mps) {
  auto options = loadLoopOptions("otter_gazebo", "none");
  EXPECT_TRUE(options.has_value());
  options->timeout_s = 200.0;
  Waters waters{test::openWater(260.0), {}, {}};
  waters.world = waters.chart;
  const double heading = heading_deg * kPi / 180.0;
  const Eigen::Vector2d course(std::sin(heading), std::cos(heading));
  waters.vessels = {
      {1, {6.0, 2.0}, true, {-50.0 * speed_mps * course, 200.0 * speed_mps * course}, {speed_mps}}};
  const scenario::Mission north = {
      "encounter", {{0.0, -100.0}, 0.5 * kPi}, {{0.0, 100.0}, 0.5 * kPi}, 2.0};
  auto loop = ClosedLoop::create(*options, waters, north, 1);
  EXPECT_TRUE(loop.has_value());
  Sailed sailed;
  Eigen::Vector2d before = loop->motion().state.head<2>();
  int steps = 0;
  bool going = true;
  while (going) {
    going = loop->step();
    if (++steps % 100 != 0) {
      continue;  // courses are means of a second
    }
    const Eigen::Vector2d now = loop->motion().state.head<2>();
    const Eigen::Vector2d moved = now - before;
    before = now;
    sailed.centres_m =
        std::min(sailed.centres_m, (loop->others().front().motion.pose.position - now).norm());
    for (const encounter::Encounter& encounter : loop->supervisor().encounters()) {
      if (sailed.role == encounter::Role::kNone) {
        sailed.role = encounter.role;
      }
    }
    const double turn = std::atan2(moved.x(), moved.y());
    // Who gives way early does so while still getting under way.
    if (loop->time() > 5.0 && now.y() < 80.0) {
      sailed.starboard_max_rad = std::max(sailed.starboard_max_rad, turn);
    }
    if (loop->time() > 12.0 && now.y() < 80.0) {
      sailed.port_max_rad = std::max(sailed.port_max_rad, -turn);
      sailed.slowest_mps = std::min(sailed.slowest_mps, moved.norm());
      if (std::abs(turn) > 0.0873) {
        sailed.first_turn_s = std::min(sailed.first_turn_s, loop->time());
      }
    }
  }
  sailed.outcome = loop->result({}).outcome;
  return sailed;
}

// Half a length of hers, half a length of ours and the 10 m that are kept between the outlines.
constexpr double kAbeamM = 10.0 + 1.0 + 0.54;

TEST(Encounters, HeadOnTurnsToStarboardApparently) {
  const Sailed sailed = meet(180.0, 2.0);
  EXPECT_EQ(sailed.outcome, scenario::Outcome::kArrived);
  EXPECT_EQ(sailed.role, encounter::Role::kHeadOn);
  EXPECT_GT(sailed.centres_m, kAbeamM);
  EXPECT_GT(sailed.starboard_max_rad, 0.5);
}

TEST(Encounters, CrossingFromStarboardIsGivenWayTo) {
  const Sailed sailed = meet(270.0, 2.0);
  EXPECT_EQ(sailed.outcome, scenario::Outcome::kArrived);
  EXPECT_EQ(sailed.role, encounter::Role::kGiveWay);
  EXPECT_GT(sailed.centres_m, kAbeamM);
  EXPECT_TRUE(sailed.starboard_max_rad > 0.5 || sailed.slowest_mps < 1.05)
      << sailed.starboard_max_rad << " rad, " << sailed.slowest_mps << " m/s";
}

// From port: nothing until 30 s are left, for she should act; then what is needed, for she doesn't.
TEST(Encounters, CrossingFromPortIsStoodOnFor) {
  const Sailed sailed = meet(90.0, 2.0);
  EXPECT_EQ(sailed.outcome, scenario::Outcome::kArrived);
  EXPECT_EQ(sailed.role, encounter::Role::kStandOn);
  EXPECT_GT(sailed.centres_m, kAbeamM);
  EXPECT_GT(sailed.first_turn_s, 20.0);
}

}  // namespace
}  // namespace otter_nav::simulation
