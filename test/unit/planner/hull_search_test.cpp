#include "planner/hull_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/base/random.hpp"
#include "otter_nav/feasibility/verifier.hpp"
#include "otter_nav/trajectory/boundary.hpp"
#include "planner/creeping.hpp"
#include "planner_ground.hpp"

namespace otter_nav::planner {
namespace {

using vessel::Pose;

constexpr int kMostSteps = 400000;
const vessel::Hull kHull{2.0, 1.08};

// The least that the rectangle's outline keeps along the way, looked at every 2 cm and 1 degree.
double keeps(const std::vector<Pose>& way, const map::DistanceField& field) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Eigen::Vector2d leg = way[i].position - way[i - 1].position;
    const double turn = way[i].psi_rad - way[i - 1].psi_rad;
    EXPECT_TRUE(leg.norm() < 1e-6 || std::abs(turn) < 1e-9) << "turns while it goes, at " << i;
    if (leg.norm() > 1e-6) {
      EXPECT_NEAR(std::abs(leg.normalized().dot(unitVector(way[i].psi_rad))), 1.0, 1e-6);
    }
    const int steps = 1 + static_cast<int>(std::max(leg.norm() / 0.02, std::abs(turn) / 0.02));
    for (int k = 0; k <= steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      least = std::min(
          least, feasibility::outlineClearance(
                     kHull, way[i - 1].position + share * leg, way[i - 1].psi_rad + share * turn,
                     [&](const Eigen::Vector2d& p) { return field.clearance(p); }));
    }
  }
  return least;
}

bool goesAstern(const std::vector<Pose>& way) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Eigen::Vector2d leg = way[i].position - way[i - 1].position;
    if (leg.dot(unitVector(way[i].psi_rad)) < -1e-6) {
      return true;
    }
  }
  return false;
}

void expectLeads(const std::vector<Pose>& way, const Pose& start, const Pose& goal) {
  ASSERT_GE(way.size(), 2U);
  EXPECT_LT((way.front().position - start.position).norm(), 1e-9);
  EXPECT_LT(std::abs(way.front().psi_rad - start.psi_rad), 1e-9);
  EXPECT_LT((way.back().position - goal.position).norm(), 1e-9);
  EXPECT_LT(std::abs(wrapAngle(way.back().psi_rad - goal.psi_rad)), 1e-9);
}

TEST(HullSearch, InOpenWaterItTurnsGoesAndTurns) {
  HullSearch search(kHull);
  const Pose start{{0.0, 0.0}, 0.0};
  const Pose goal{{0.0, 8.0}, 0.0};
  const map::DistanceField open = test::openWater();
  const std::vector<Pose> way = search.find(open, start, goal, {0.65, 0.1}, kMostSteps);
  expectLeads(way, start, goal);
  EXPECT_EQ(way.size(), 4U);
}

// A canal that the hull can't turn in, with the goal behind it.
TEST(HullSearch, GoesAsternOutOfACanal) {
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, 0.0, 0.75, 12.0, 1.0);
  test::fill(grid, 0.0, -1.75, 12.0, 1.0);
  const map::DistanceField field(grid, {});
  HullSearch search(kHull);
  const Pose start{{6.0, 0.0}, 0.0};
  const Pose goal{{-4.0, 3.0}, kPi / 2.0};
  const std::vector<Pose> way = search.find(field, start, goal, {0.65, 0.05}, kMostSteps);
  expectLeads(way, start, goal);
  EXPECT_TRUE(goesAstern(way));
  EXPECT_GE(keeps(way, field), 0.05);
}

// What a search reached is nothing to the next, from wherever that begins.
TEST(HullSearch, FindsTheSameAgainAsForTheFirstTime) {
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, 0.0, 0.75, 12.0, 1.0);
  test::fill(grid, 0.0, -1.75, 12.0, 1.0);
  const map::DistanceField field(grid, {});
  const HullRoom room{0.65, 0.05};
  HullSearch again(kHull);
  Random random(3);
  int found = 0;
  for (int k = 0; k < 12; ++k) {
    const Pose start{{random.uniform(4.0, 8.0), 0.0}, random.uniform(-0.03, 0.03)};
    const Pose goal{{random.uniform(-6.0, -3.0), random.uniform(-4.0, 4.0)},
                    random.uniform(-kPi, kPi)};
    const std::vector<Pose> way = again.find(field, start, goal, room, kMostSteps);
    const std::vector<Pose> first = HullSearch(kHull).find(field, start, goal, room, kMostSteps);
    ASSERT_EQ(way.size(), first.size()) << k;
    for (std::size_t i = 0; i < way.size(); ++i) {
      EXPECT_EQ(way[i].position, first[i].position) << k;
      EXPECT_EQ(way[i].psi_rad, first[i].psi_rad) << k;
    }
    found += way.empty() ? 0 : 1;
  }
  EXPECT_GE(found, 6);
}

TEST(HullSearch, FindsNothingThroughASlotNarrowerThanTheHull) {
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, -40.0, 3.0, 39.5, 1.0);  // 1 m between them
  test::fill(grid, 0.5, 3.0, 39.5, 1.0);
  const map::DistanceField field(grid, {});
  HullSearch search(kHull);
  const Pose start{{0.0, 0.0}, kPi / 2.0};
  EXPECT_TRUE(search.find(field, start, {{0.0, 7.0}, kPi / 2.0}, {0.5, 0.02}, kMostSteps).empty());
}

// A canal longer than what is gone straight to the goal, 4 degrees off the heading that she lies
// on, with 5 cm beside what is to be kept there.
TEST(HullSearch, PassesATightCanalThatLiesAskew) {
  constexpr double kAskewRad = 0.07;
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, -40.0, 3.0, 39.25, 12.0);
  test::fill(grid, 0.75, 3.0, 39.25, 12.0);
  const map::DistanceField field(grid, {});
  HullSearch search(kHull);
  const HullRoom room{0.55, 0.03};
  for (const double askew_rad : {kAskewRad, -kAskewRad}) {
    const Pose start{{0.0, 0.0}, kPi / 2.0 + askew_rad};
    const Pose goal{{0.0, 18.0}, kPi / 2.0};
    const std::vector<Pose> way = search.find(field, start, goal, room, kMostSteps);
    expectLeads(way, start, goal);
    EXPECT_GE(keeps(way, field), room.beside_m);
  }
}

// A wall four metres thick to the north, with a gap straight ahead and a wide one aside.
map::DistanceField twoGaps(double from_x, double to_x) {
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, -40.0, 4.0, 40.0 + from_x, 4.0);
  test::fill(grid, to_x, 4.0, 1.75 - to_x, 4.0);
  test::fill(grid, 9.0, 4.0, 31.0, 4.0);
  return map::DistanceField(grid, {});
}

bool passesAhead(const std::vector<Pose>& way) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Eigen::Vector2d& a = way[i - 1].position;
    const Eigen::Vector2d& b = way[i].position;
    if (a.y() < 6.0 && b.y() >= 6.0) {
      const double share = (6.0 - a.y()) / (b.y() - a.y());
      return std::abs(a.x() + share * (b.x() - a.x())) < 1.5;
    }
  }
  return false;
}

// Half the way again and more turns are worth it where there is less than 0.1 m to either side, and
// not where there is half a metre.
TEST(HullSearch, PrefersAWideGapToANarrowOne) {
  HullSearch search(kHull);
  const Pose start{{0.125, 0.0}, kPi / 2.0};
  const Pose goal{{0.125, 12.0}, kPi / 2.0};
  const map::DistanceField narrow = twoGaps(-0.5, 0.75);
  const std::vector<Pose> round = search.find(narrow, start, goal, {0.6, 0.02}, kMostSteps);
  expectLeads(round, start, goal);
  EXPECT_FALSE(passesAhead(round));
  EXPECT_GE(keeps(round, narrow), 0.25);
  const std::vector<Pose> through =
      search.find(twoGaps(-1.0, 1.25), start, goal, {0.6, 0.02}, kMostSteps);
  expectLeads(through, start, goal);
  EXPECT_TRUE(passesAhead(through));
}

// The same gap is wide enough for a hull that lies still, and not for one that a wind from abeam
// swings.
TEST(HullSearch, LeavesRoomOnHeadingsOnWhichTheHullSwings) {
  HullSearch search(kHull);
  const Pose start{{0.0, 0.0}, kPi / 2.0};
  const Pose goal{{0.0, 12.0}, kPi / 2.0};
  const map::DistanceField field = twoGaps(-0.75, 0.75);
  const auto in_wind = [](const Eigen::Vector2d& wind) {
    return [wind](double psi_rad) { return 0.8 * std::abs(cross(unitVector(psi_rad), wind)); };
  };
  const std::vector<Pose> along =
      search.find(field, start, goal, {0.6, 0.02, in_wind({0.0, 1.0})}, kMostSteps);
  expectLeads(along, start, goal);
  EXPECT_TRUE(passesAhead(along));
  const std::vector<Pose> across =
      search.find(field, start, goal, {0.6, 0.02, in_wind({1.0, 0.0})}, kMostSteps);
  expectLeads(across, start, goal);
  EXPECT_FALSE(passesAhead(across));
}

TEST(HullSearch, GivesUpWhenToldTo) {
  HullSearch search(kHull);
  const map::DistanceField field = test::openWater();
  const Pose far{{12.0, 8.0}, 0.0};
  EXPECT_TRUE(search.find(field, {}, far, {0.65, 0.1}, 5).empty());
  EXPECT_TRUE(search.find(field, {}, far, {0.65, 0.1}, kMostSteps, [] { return true; }).empty());
  EXPECT_TRUE(search.find(field, {}, {{30.0, 0.0}, 0.0}, {0.65, 0.1}, kMostSteps).empty());
}

// Posts at random, a third of a metre wide: whatever is found keeps what was asked for, is sailed
// within the limits, and most goals are reached.
TEST(HullSearch, ThroughPostsItKeepsWhatItWasAskedFor) {
  const vessel::Parameters vessel;
  Random random(7);
  HullSearch search(kHull);
  int found = 0;
  int tried = 0;
  for (int field_no = 0; field_no < 8; ++field_no) {
    map::OccupancyGrid grid = test::openGrid();
    for (int k = 0; k < 150; ++k) {
      const Eigen::Vector2d p(random.uniform(-14.0, 14.0), random.uniform(-14.0, 14.0));
      if (p.cwiseAbs().maxCoeff() < 13.5) {
        test::fill(grid, p.x(), p.y(), 0.3, 0.3);
      }
    }
    const map::DistanceField field(grid, {});
    const Pose start{{-15.2, 0.0}, kPi / 2.0};
    const Pose goal{{0.0, 15.2}, 0.0};
    const HullRoom room{0.64, 0.05};
    if (field.clearance(start.position) < 1.2 || field.clearance(goal.position) < 1.2) {
      continue;
    }
    ++tried;
    const std::vector<Pose> way = search.find(field, start, goal, room, kMostSteps);
    if (way.empty()) {
      continue;
    }
    ++found;
    expectLeads(way, start, goal);
    EXPECT_GE(keeps(way, field), room.beside_m);
    auto limits = feasibility::SafetyLimits::of(vessel, room.centre_m);
    limits.hull_margin_m = room.beside_m;
    const trajectory::Trajectory creeping = creepAlong(way, vessel, limits);
    trajectory::Boundary from;
    from.flat.position = start.position;
    from.psi_rad = start.psi_rad;
    trajectory::Boundary to;
    to.flat.position = goal.position;
    to.psi_rad = goal.psi_rad;
    const auto verified = feasibility::verify(creeping, field, vessel, from, to, limits);
    EXPECT_TRUE(verified.ok) << verified.reason;
  }
  EXPECT_GE(found, 6);
  EXPECT_EQ(tried, 8);
}

}  // namespace
}  // namespace otter_nav::planner
