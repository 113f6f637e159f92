#include "archipelago/archipelago.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/vessel/hull.hpp"

namespace otter_nav::scenario {
namespace {

ArchipelagoOptions small() {
  ArchipelagoOptions options;
  options.size_m = 120.0;
  options.resolution_m = 0.5;
  options.islands = 40.0;
  options.local_missions = 3;
  options.local_distance_m = 40.0;
  options.cross_missions = 2;
  return options;
}

// The test's own flood fill, cell by cell on the clearance.
bool connected(const map::DistanceField& field, const Eigen::Vector2d& from,
               const Eigen::Vector2d& to, double clearance_m) {
  const map::GridGeometry& g = field.geometry();
  const auto cells = static_cast<std::size_t>(g.width) * static_cast<std::size_t>(g.height);
  std::vector<char> seen(cells, 0);
  std::vector<Eigen::Vector2i> front = {g.cellAt(from)};
  while (!front.empty()) {
    const Eigen::Vector2i cell = front.back();
    front.pop_back();
    if (!g.containsCell(cell.x(), cell.y()) || seen[g.index(cell.x(), cell.y())] != 0 ||
        field.clearance(g.centreOf(cell.x(), cell.y())) < clearance_m) {
      continue;
    }
    seen[g.index(cell.x(), cell.y())] = 1;
    for (const auto& step : {Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0), Eigen::Vector2i(0, 1),
                             Eigen::Vector2i(0, -1)}) {
      front.push_back(cell + step);
    }
  }
  const Eigen::Vector2i end = g.cellAt(to);
  return seen[g.index(end.x(), end.y())] != 0;
}

TEST(Archipelago, WallsLeaveWaysThrough) {
  for (const Walls walls : {Walls::kStreets, Walls::kHalls, Walls::kHarbour}) {
    ArchipelagoOptions options;
    options.walls = walls;
    options.clear_m = 3.0;
    for (const std::uint64_t seed : {1U, 2U, 203U}) {  // the last has little room to begin in
      const auto water = generateArchipelago(options, seed);
      ASSERT_TRUE(water.has_value()) << water.error().message;
      EXPECT_EQ(water->chart.cells, water->world.cells);
      const map::GridGeometry& g = water->world.geometry;
      EXPECT_EQ(water->world.cells[g.index(0, g.height / 2)], map::Cell::kOccupied);
      const map::DistanceField world(water->world, {10.0, false});
      ASSERT_EQ(water->missions.size(), 14U);
      for (const Mission& mission : water->missions) {
        EXPECT_TRUE(connected(world, mission.start.position, mission.goal.position,
                              options.passage_clearance_m));
      }
    }
  }
}

TEST(Archipelago, MissionsCanBeSailedButNotStraight) {
  const ArchipelagoOptions options = small();
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto archipelago = generateArchipelago(options, seed);
    ASSERT_TRUE(archipelago.has_value()) << archipelago.error().message;
    ASSERT_EQ(archipelago->missions.size(), 5U);
    const map::DistanceField world(archipelago->world, {10.0, false});
    for (const Mission& mission : archipelago->missions) {
      const Eigen::Vector2d start = mission.start.position;
      const Eigen::Vector2d goal = mission.goal.position;
      EXPECT_GE(world.clearance(start), options.clear_m);
      EXPECT_GE(world.clearance(goal), options.clear_m);
      EXPECT_TRUE(connected(world, start, goal, options.passage_clearance_m));
      EXPECT_FALSE(map::segmentIsClear(world, start, goal, 0.0));
      const double apart = (goal - start).norm();
      if (mission.kind == "local") {
        EXPECT_NEAR(apart, 40.0, 4.01);
      } else {
        EXPECT_GE(apart, 0.63 * options.size_m);
      }
    }
  }
}

TEST(Archipelago, WorldIsTheChartAndMore) {
  const auto archipelago = generateArchipelago(small(), 4);
  ASSERT_TRUE(archipelago.has_value());
  const auto& chart = archipelago->chart.cells;
  const auto& world = archipelago->world.cells;
  int charted = 0;
  int uncharted = 0;
  for (std::size_t k = 0; k < chart.size(); ++k) {
    charted += chart[k] == map::Cell::kOccupied ? 1 : 0;
    uncharted += world[k] != chart[k] ? 1 : 0;
    if (chart[k] == map::Cell::kOccupied) {
      ASSERT_EQ(world[k], map::Cell::kOccupied);
    }
  }
  const auto cells = static_cast<int>(chart.size());
  EXPECT_GT(charted, cells / 50);
  EXPECT_LT(charted, cells / 2);
  EXPECT_GT(uncharted, 10);
}

TEST(Archipelago, SameSeedSameArchipelago) {
  const auto a = generateArchipelago(small(), 5);
  const auto b = generateArchipelago(small(), 5);
  const auto c = generateArchipelago(small(), 6);
  ASSERT_TRUE(a && b && c);
  EXPECT_EQ(a->world.cells, b->world.cells);
  EXPECT_EQ(a->missions[0].start.position, b->missions[0].start.position);
  EXPECT_NE(a->world.cells, c->world.cells);
}

void expectRoutesKeepClear(const Archipelago& archipelago, const ArchipelagoOptions& options) {
  const map::DistanceField world(archipelago.world, {30.0, false});
  for (const vessel::ScriptedVessel& vessel : archipelago.vessels) {
    EXPECT_GE(vessel.waypoints.size(), 3U);
    for (double t = 0.0; t < options.route_time_s - 1.0; t += 0.7) {
      const vessel::ScriptedMotion motion = vessel::motionAt(vessel, t);
      ASSERT_GT(motion.speed_mps, 0.0) << t;
      for (const Eigen::Vector2d& corner :
           vessel::outline(vessel.hull, motion.pose.position, motion.pose.psi_rad)) {
        EXPECT_GE(world.clearance(corner), options.route_clear_m - 1e-6);
      }
      for (const Mission& mission : archipelago.missions) {
        EXPECT_GE((mission.start.position - motion.pose.position).norm(), 8.0);
        EXPECT_GE((mission.goal.position - motion.pose.position).norm(), 8.0);
      }
    }
  }
}

TEST(Archipelago, VesselsKeepClearOfLandAndOfEveryStartAndGoal) {
  ArchipelagoOptions options = small();
  options.size_m = 250.0;
  options.islands = 18.0;
  options.vessels = 4;
  const ArchipelagoOptions without = [&] {
    ArchipelagoOptions o = options;
    o.vessels = 0;
    return o;
  }();
  for (const std::uint64_t seed : {1U, 2U}) {
    const auto archipelago = generateArchipelago(options, seed);
    ASSERT_TRUE(archipelago.has_value()) << archipelago.error().message;
    ASSERT_EQ(archipelago->vessels.size(), 4U);
    EXPECT_EQ(archipelago->world.cells, generateArchipelago(without, seed)->world.cells);
    expectRoutesKeepClear(*archipelago, options);
  }
}

TEST(Archipelago, VesselsFindRoutesInSmallWaters) {
  ArchipelagoOptions options;
  options.size_m = 160.0;
  options.vessels = 6;
  constexpr std::uint64_t kSeeds = 12;
  int found = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto archipelago = generateArchipelago(options, seed);
    if (!archipelago) {  // no pocket is large enough
      EXPECT_NE(archipelago.error().message.find("a larger map"), std::string::npos);
      continue;
    }
    ++found;
    ASSERT_EQ(archipelago->vessels.size(), 6U);
    expectRoutesKeepClear(*archipelago, options);
  }
  EXPECT_GE(found, 9);
}

TEST(Archipelago, RefusesWhatCantBeDrawn) {
  ArchipelagoOptions options = small();
  options.size_m = -1.0;
  auto refused = generateArchipelago(options, 1);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("size"), std::string::npos);
  options = small();
  options.islands = 2000.0;
  refused = generateArchipelago(options, 1);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("no local mission"), std::string::npos);
}

}  // namespace
}  // namespace otter_nav::scenario
