#include "otter_nav/topology/guide_path.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/config/fields.hpp"
#include "topology/lattice_search.hpp"

namespace otter_nav::topology {
namespace {

using map::Cell;
using map::OccupancyGrid;

// 60 m by 60 m of water around the origin.
OccupancyGrid water() {
  OccupancyGrid grid;
  grid.geometry = {240, 240, 0.25, {-30.0, -30.0}};
  grid.cells.assign(240UL * 240UL, Cell::kFree);
  return grid;
}

void fill(OccupancyGrid& grid, double x0, double y0, double x1, double y1) {
  for (int row = 0; row < grid.geometry.height; ++row) {
    for (int column = 0; column < grid.geometry.width; ++column) {
      const Eigen::Vector2d p = grid.geometry.centreOf(column, row);
      if (p.x() > x0 && p.x() < x1 && p.y() > y0 && p.y() < y1) {
        grid.cells[grid.geometry.index(column, row)] = Cell::kOccupied;
      }
    }
  }
}

void expectClear(const map::DistanceField& field, const GuidePath& path, double clearance_m) {
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    EXPECT_TRUE(map::segmentIsClear(field, path.points[i - 1], path.points[i], clearance_m));
  }
}

TEST(GuidePathFinder, OpenWaterIsTheStraightLine) {
  const map::DistanceField field(water(), {});
  GuidePathFinder finder({});
  const auto path = finder.find(field, {{-20.0, 0.0}, 0.0}, {{20.0, 0.0}, 0.0});
  ASSERT_TRUE(path) << path.error().message;
  EXPECT_EQ(path->points.size(), 2U);
  EXPECT_NEAR(path->length_m, 40.0, 1e-9);
  EXPECT_TRUE(path->collisions_m.empty());
  EXPECT_TRUE(path->repaired_dubins);
  ASSERT_EQ(path->corridor_m.size(), 2U);
  EXPECT_NEAR(path->corridor_m[0], 6.0, 1e-9);
}

// What a search met on one map is nothing to the next.
TEST(LatticeSearch, FindsTheSameOnAnotherMapAsForTheFirstTime) {
  OccupancyGrid grid = water();
  fill(grid, -2.0, -25.0, 2.0, 20.0);
  const map::DistanceField field(grid, {});
  OccupancyGrid mirrored = water();
  fill(mirrored, -2.0, -20.0, 2.0, 25.0);
  const map::DistanceField other(mirrored, {});
  LatticeQuery query;
  query.start = {-20.0, 0.0};
  query.goal = {20.0, 0.0};
  query.low = {-30.0, -30.0};
  query.high = {30.0, 30.0};
  query.max_expansions = 100000;
  LatticeSearch search;
  std::vector<Eigen::Vector2d> again;
  std::vector<Eigen::Vector2d> first;
  ASSERT_EQ(search.run(field, query, again), LatticeSearch::Outcome::kFound);
  ASSERT_EQ(search.run(other, query, again), LatticeSearch::Outcome::kFound);
  ASSERT_EQ(LatticeSearch().run(other, query, first), LatticeSearch::Outcome::kFound);
  EXPECT_EQ(again, first);
}

// Round a square of 4 m: tangents to arcs of radius clearance + margin about two corners.
TEST(GuidePathFinder, RoundsABlockNearTheShortestWay) {
  OccupancyGrid grid = water();
  fill(grid, -2.0, -2.5, 2.0, 1.5);
  const map::DistanceField field(grid, {});
  GuidePathFinder finder({});
  const auto path = finder.find(field, {{-20.0, 0.0}, 0.0}, {{20.0, 0.0}, 0.0});
  ASSERT_TRUE(path) << path.error().message;
  const double r = 0.82;
  const double leg = std::hypot(18.0, 1.5);
  const double turn = std::atan2(1.5, 18.0) + std::asin(r / leg);
  const double shortest = 2.0 * (std::sqrt(leg * leg - r * r) + r * turn) + 4.0;
  EXPECT_GE(path->length_m, shortest - 1e-3);
  EXPECT_LE(path->length_m, 1.002 * shortest);
  EXPECT_EQ(path->collisions_m.size(), 1U);
  EXPECT_FALSE(path->pushed_points.empty());
  for (const Eigen::Vector2d& p : path->pushed_points) {
    EXPECT_GE(field.clearance(p), 1.2);
  }
  expectClear(field, *path, 0.8);
}

TEST(GuidePathFinder, DubinsCurveKeepsTheHeadings) {
  const map::DistanceField field(water(), {});
  GuidePathFinder finder({});
  const auto path = finder.find(field, {{-20.0, 0.0}, 1.0}, {{20.0, 5.0}, -2.0});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->dubins.front().psi_rad, 1.0, 1e-9);
  EXPECT_NEAR(wrapAngle(path->dubins.back().psi_rad + 2.0), 0.0, 1e-9);
  EXPECT_NEAR((path->dubins.back().position - Eigen::Vector2d(20.0, 5.0)).norm(), 0.0, 1e-6);
}

TEST(GuidePathFinder, FindsTheGapInAWall) {
  OccupancyGrid grid = water();
  fill(grid, -1.0, -30.0, 1.0, 20.0);
  fill(grid, -1.0, 22.0, 1.0, 30.0);  // 2 m wide, 1.7 m needed
  const map::DistanceField field(grid, {});
  GuidePathFinder finder({});
  const auto path = finder.find(field, {{-20.0, -10.0}, 0.0}, {{20.0, -10.0}, 0.0});
  ASSERT_TRUE(path) << path.error().message;
  expectClear(field, *path, 0.8);
  EXPECT_LT(path->length_m, 1.02 * 2.0 * std::hypot(20.0, 31.0));
}

TEST(GuidePathFinder, SaysWhatIsBlocked) {
  OccupancyGrid grid = water();
  fill(grid, 9.0, -5.0, 11.0, 5.0);
  const map::DistanceField field(grid, {});
  GuidePathFinder finder({});
  GuidePath path;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Pose good{{-20.0, 0.0}, 0.0};
  const auto failure_of = [&](const Pose& start, const Pose& goal, const std::string& part) {
    const auto found = finder.find(field, start, goal, path);
    EXPECT_FALSE(found);
    EXPECT_NE(found.error().message.find(part), std::string::npos) << found.error().message;
    return found.error().failure;
  };
  EXPECT_EQ(failure_of({{10.0, 0.0}, 0.0}, good, "start (10, 0) is inside an obstacle"),
            Failure::kStartBlocked);
  EXPECT_EQ(failure_of({{8.5, 0.0}, 0.0}, good, "m from an obstacle, 0.8 m are needed"),
            Failure::kStartBlocked);
  EXPECT_EQ(failure_of({{nan, 0.0}, 0.0}, good, "not a number"), Failure::kStartBlocked);
  EXPECT_EQ(failure_of(good, {{31.0, 0.0}, 0.0}, "goal (31, 0) is outside the map"),
            Failure::kGoalBlocked);
  EXPECT_EQ(failure_of(good, {{0.0, 0.0}, nan}, "goal is not a number"), Failure::kGoalBlocked);
}

TEST(GuidePathFinder, WalledInGoalHasNoWay) {
  OccupancyGrid grid = water();
  fill(grid, 10.0, -10.0, 25.0, 10.0);
  for (int row = 0; row < 240; ++row) {  // hollow
    for (int column = 0; column < 240; ++column) {
      const Eigen::Vector2d p = grid.geometry.centreOf(column, row);
      if ((p - Eigen::Vector2d(17.5, 0.0)).cwiseAbs().maxCoeff() < 5.0) {
        grid.cells[grid.geometry.index(column, row)] = Cell::kFree;
      }
    }
  }
  const map::DistanceField field(grid, {});
  GuidePathFinder finder({});
  GuidePath path;
  const auto found = finder.find(field, {{-20.0, 0.0}, 0.0}, {{17.5, 0.0}, 0.0}, path);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().failure, Failure::kNoPath);
}

TEST(GuidePathFinder, StartNearAnObstacleMayLeave) {
  OccupancyGrid grid = water();
  fill(grid, -2.0, -2.0, 2.0, 2.0);
  const map::DistanceField field(grid, {});
  GuidePathFinder finder({});
  const auto path = finder.find(field, {{-2.805, 0.0}, 0.0}, {{20.0, 0.0}, 0.0});
  ASSERT_TRUE(path) << path.error().message;
  expectClear(field, *path, 0.8);
}

TEST(GuidePathFinder, KeepsTheClearanceAskedFor) {
  OccupancyGrid grid = water();
  fill(grid, -2.0, -2.0, 2.0, 2.0);
  const map::DistanceField field(grid, {});
  GuidePathFinder finder({});
  const auto narrow = finder.find(field, {{-20.0, 0.0}, 0.0}, {{20.0, 0.0}, 0.0});
  const auto wide = finder.find(field, {{-20.0, 0.0}, 0.0}, {{20.0, 0.0}, 0.0}, 2.5);
  ASSERT_TRUE(narrow && wide);
  expectClear(field, *wide, 2.5);
  EXPECT_GT(wide->length_m, narrow->length_m);
}

TEST(TopologyOptions, ShippedFileHoldsTheDefaults) {
  const auto options =
      config::load<Options>(std::string(OTTER_NAV_SOURCE_DIR) + "/config/topology.yaml");
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(config::toYaml(*options), config::toYaml(Options{}));
}

// A channel that slants across the cells: steps along these pass it only where it is several
// centimetres wider than the clearance, in cells of 0.1 m.
TEST(GuidePathFinder, PassesNarrowChannelsAtAnySlant) {
  for (const double slope : {0.0, 0.2, 0.35, 0.5, 0.7, 1.0}) {
    OccupancyGrid grid;
    grid.geometry = {80, 80, 0.1, {-4.0, -4.0}};
    grid.cells.assign(80UL * 80UL, Cell::kFree);
    const Eigen::Vector2d along = Eigen::Vector2d(1.0, slope).normalized();
    const Eigen::Vector2d side(-along.y(), along.x());
    const auto offAxis = [&](const Eigen::Vector2d& p) {
      return std::abs(side.dot(p - Eigen::Vector2d(0.03, 0.01)));
    };
    for (int row = 0; row < 80; ++row) {
      for (int column = 0; column < 80; ++column) {
        const Eigen::Vector2d p = grid.geometry.centreOf(column, row);
        if (std::abs(p.x()) < 1.5 && offAxis(p) > 0.6) {
          grid.cells[grid.geometry.index(column, row)] = Cell::kOccupied;
        }
      }
    }
    const map::DistanceField field(grid, {});
    double room = std::numeric_limits<double>::infinity();
    const auto onAxis = [&](double s) -> Eigen::Vector2d {
      return Eigen::Vector2d(0.03, 0.01) + s * along;
    };
    for (double s = -2.2; s <= 2.2; s += 0.01) {
      room = std::min(room, field.clearance(onAxis(s)));
    }
    GuidePathFinder finder({});
    const double clearance = room - 0.02;
    const auto path = finder.find(field, {onAxis(-2.2), 0.0}, {onAxis(2.2), 0.0}, clearance);
    ASSERT_TRUE(path) << slope << ": " << path.error().message;
    expectClear(field, *path, clearance - 1e-3);
  }
}

}  // namespace
}  // namespace otter_nav::topology
