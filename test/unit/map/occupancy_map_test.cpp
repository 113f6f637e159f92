#include "otter_nav/map/occupancy_map.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <set>
#include <utility>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/random.hpp"

namespace otter_nav::map {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const OccupancyMapOptions kOptions;
const vessel::Hull kHull{2.0, 1.08};

// 40 m by 40 m around the origin, land west of x = -15.
OccupancyGrid coast() {
  OccupancyGrid grid;
  grid.geometry = {160, 160, 0.25, {-20.0, -20.0}};
  grid.cells.assign(160UL * 160UL, Cell::kFree);
  for (int row = 0; row < 160; ++row) {
    for (int column = 0; column < 20; ++column) {
      grid.cells[grid.geometry.index(column, row)] = Cell::kOccupied;
    }
  }
  return grid;
}

Scan openWater(std::size_t beams = 720) {
  return {-kPi, 2.0 * kPi / static_cast<double>(beams), 0.2, 15.0, std::vector<float>(beams, kInf)};
}

// One beam ahead.
Scan aheadOnly(float range) {
  return {0.0, 0.0, 0.2, 15.0, {range}};
}

SensorPose sensorAt(double x, double y, double yaw = 0.0) {
  return {{x, y, 0.8}, 0.0, 0.0, yaw};
}

// The sensor sits over the hull's middle.
Result<CellRectangle> insert(OccupancyMap& map, const SensorPose& sensor, const Scan& scan) {
  return map.insertScan(sensor, {sensor.position.head<2>(), sensor.yaw_rad}, scan);
}

Cell cellAt(const OccupancyMap& map, double x, double y) {
  const Eigen::Vector2i cell = map.projection().geometry.cellAt({x, y});
  return map.projection().at(cell.x(), cell.y());
}

TEST(OccupancyMap, FloatingObstacleAppearsAndClears) {
  OccupancyMap map(coast(), kHull, kOptions);
  for (int i = 0; i < 10; ++i) {  // open water, certainly
    ASSERT_TRUE(insert(map, sensorAt(0.0, 0.0), openWater()));
  }
  const auto first = insert(map, sensorAt(0.0, 0.0), aheadOnly(5.1F));
  ASSERT_TRUE(first);
  const auto second = insert(map, sensorAt(0.0, 0.0), aheadOnly(5.1F));
  ASSERT_TRUE(second);
  EXPECT_EQ(cellAt(map, 5.1, 0.0), Cell::kOccupied);
  EXPECT_EQ(second->width, 1);
  EXPECT_EQ(second->height, 1);
  EXPECT_EQ(map.projection().geometry.centreOf(second->column, second->row),
            Eigen::Vector2d(5.125, 0.125));
  int misses = 0;
  while (cellAt(map, 5.1, 0.0) == Cell::kOccupied && misses < 50) {
    ASSERT_TRUE(insert(map, sensorAt(0.0, 0.0), aheadOnly(kInf)));
    ++misses;
  }
  EXPECT_GT(misses, 1);
  EXPECT_LT(misses, 15);
}

// What is filled in stays until beams pass there; land is land.
TEST(OccupancyMap, WhatIsFilledInClearsWhereBeamsPass) {
  OccupancyMap map(coast(), kHull, kOptions);
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(insert(map, sensorAt(0.0, 0.0), openWater()));
  }
  const CellRectangle changed = map.fill({{5.1, 0.0, 0.8}, {-17.0, 0.0, 0.8}, {5.1, 4.0, 99.0}});
  EXPECT_EQ(changed.width * changed.height, 1);
  EXPECT_EQ(cellAt(map, 5.1, 0.0), Cell::kOccupied);
  EXPECT_EQ(cellAt(map, 5.1, 4.0), Cell::kFree);
  ASSERT_TRUE(insert(map, sensorAt(0.0, 0.0), aheadOnly(4.5F)));
  EXPECT_EQ(cellAt(map, 5.1, 0.0), Cell::kOccupied);
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(insert(map, sensorAt(0.0, 0.0), aheadOnly(kInf)));
  }
  EXPECT_EQ(cellAt(map, 5.1, 0.0), Cell::kFree);
}

// Where one echo is not enough to make an obstacle, it makes no free water either.
TEST(OccupancyMap, TakesNoEchoForFreeWater) {
  OccupancyGrid chart = coast();
  std::fill(chart.cells.begin(), chart.cells.end(), Cell::kUnknown);
  OccupancyMapOptions options = kOptions;
  options.hit_probability = 0.65;
  options.occupied_probability = 0.7;
  OccupancyMap map(chart, kHull, options);
  EXPECT_FALSE(map.fill({{5.1, 4.0, 0.8}}).empty());
  EXPECT_EQ(cellAt(map, 5.1, 4.0), Cell::kOccupied);
  ASSERT_TRUE(insert(map, sensorAt(0.0, 0.0), aheadOnly(5.1F)));
  EXPECT_EQ(cellAt(map, 5.1, 0.0), Cell::kUnknown);
  ASSERT_TRUE(insert(map, sensorAt(0.0, 0.0), aheadOnly(5.1F)));
  EXPECT_EQ(cellAt(map, 5.1, 0.0), Cell::kOccupied);
}

TEST(OccupancyMap, ChartedLandStays) {
  OccupancyMap map(coast(), kHull, kOptions);
  for (int i = 0; i < 30; ++i) {
    const auto changed = insert(map, sensorAt(-10.0, 0.0), openWater());
    ASSERT_TRUE(changed);
    EXPECT_TRUE(changed->empty());
  }
  EXPECT_EQ(map.projection().cells, coast().cells);
}

TEST(OccupancyMap, UnknownWaterBecomesFreeWhereBeamsPass) {
  OccupancyGrid chart = coast();
  std::fill(chart.cells.begin(), chart.cells.end(), Cell::kUnknown);
  OccupancyMap map(chart, kHull, kOptions);
  const auto changed = insert(map, sensorAt(0.0, 0.0), aheadOnly(kInf));
  ASSERT_TRUE(changed);
  EXPECT_EQ(cellAt(map, 7.0, 0.1), Cell::kFree);
  EXPECT_EQ(cellAt(map, 16.0, 0.1), Cell::kUnknown);  // beyond range_max
  EXPECT_EQ(cellAt(map, -2.0, 0.1), Cell::kUnknown);
  EXPECT_EQ(changed->height, 1);
  EXPECT_NEAR(changed->width, 60, 1);
}

TEST(OccupancyMap, Rep117ValuesThatSayNothing) {
  OccupancyGrid chart = coast();
  std::fill(chart.cells.begin(), chart.cells.end(), Cell::kUnknown);
  for (const float range : {-kInf, kNan, 0.1F, 16.0F}) {
    OccupancyMap map(chart, kHull, kOptions);
    const auto changed = insert(map, sensorAt(0.0, 0.0), aheadOnly(range));
    ASSERT_TRUE(changed) << range;
    EXPECT_TRUE(changed->empty()) << range;
  }
}

TEST(OccupancyMap, TiltedBeamsMeetWaterOrSky) {
  for (const double pitch : {0.2, -0.2}) {  // bow down: 5 m ahead the beam is under water
    OccupancyMap map(coast(), kHull, kOptions);
    SensorPose sensor = sensorAt(0.0, 0.0);
    sensor.pitch_rad = pitch;
    const float range = pitch > 0.0 ? 5.0F : 10.0F;
    ASSERT_TRUE(insert(map, sensor, aheadOnly(range)));
    EXPECT_EQ(map.projection().cells, coast().cells);
    sensor.pitch_rad = 0.0;
    ASSERT_TRUE(insert(map, sensor, aheadOnly(range)));
    EXPECT_EQ(cellAt(map, range, 0.0), Cell::kOccupied);
  }
  OccupancyMap map(coast(), kHull, kOptions);  // roll turns a beam abeam down, and leaves one ahead
  SensorPose rolled = sensorAt(0.0, 0.0);
  rolled.roll_rad = -0.2;
  ASSERT_TRUE(insert(map, rolled, {0.5 * kPi, 0.1, 0.2, 15.0, {6.0F}}));
  EXPECT_EQ(map.projection().cells, coast().cells);
}

TEST(OccupancyMap, OwnHullIsNeitherMarkedNorStays) {
  OccupancyMap map(coast(), kHull, kOptions);
  ASSERT_TRUE(insert(map, sensorAt(0.0, 0.0), aheadOnly(0.9F)));
  EXPECT_EQ(map.projection().cells, coast().cells);
  ASSERT_TRUE(insert(map, sensorAt(0.0, 0.0), aheadOnly(3.1F)));
  EXPECT_EQ(cellAt(map, 3.1, 0.0), Cell::kOccupied);
  // Across the place, its bow north: the cell lies within the beam.
  const auto changed = insert(map, sensorAt(3.0, 0.5, 0.5 * kPi), aheadOnly(-kInf));
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->width, 1);
  EXPECT_EQ(map.projection().cells, coast().cells);
}

// A lidar ahead of the hull's middle: the mask lies where the hull lies, not around the sensor.
TEST(OccupancyMap, OnlyTheHullIsMaskedWhereverTheSensorSits) {
  const vessel::Pose own{{0.0, 0.0}, 0.5 * kPi};  // bow north at y = 1, stern at y = -1
  const SensorPose sensor = sensorAt(0.0, 0.5, 0.5 * kPi);
  OccupancyMap map(coast(), kHull, kOptions);
  ASSERT_TRUE(map.insertScan(sensor, own, aheadOnly(0.6F)));  // 0.1 m off the bow: the margin
  ASSERT_TRUE(map.insertScan(sensor, own, {kPi, 0.1, 0.2, 15.0, {1.6F}}));  // and off the stern
  EXPECT_EQ(map.projection().cells, coast().cells);
  ASSERT_TRUE(map.insertScan(sensor, own, aheadOnly(0.9F)));  // 0.4 m off the bow
  EXPECT_EQ(cellAt(map, 0.01, 1.4), Cell::kOccupied);
  ASSERT_TRUE(map.insertScan(sensor, own, openWater(1)));
  EXPECT_EQ(cellAt(map, 0.01, 1.4), Cell::kOccupied);
  // What drifted under the stern is gone.
  ASSERT_TRUE(
      map.insertScan(sensorAt(0.0, -4.0, 0.5 * kPi), {{0.0, -4.0}, 0.5 * kPi}, aheadOnly(3.1F)));
  ASSERT_EQ(cellAt(map, 0.01, -0.9), Cell::kOccupied);
  ASSERT_TRUE(map.insertScan(sensor, own, openWater(1)));
  EXPECT_EQ(cellAt(map, 0.01, -0.9), Cell::kFree);
}

// It was seen from farther off; right beside the hull its echoes may be the hull's own, but what is
// known of it stays until a beam has passed there.
TEST(OccupancyMap, WhatLiesBesideTheHullStays) {
  OccupancyMap map(coast(), kHull, kOptions);
  ASSERT_TRUE(insert(map, sensorAt(0.7, -4.0, 0.5 * kPi), aheadOnly(4.1F)));
  ASSERT_EQ(cellAt(map, 0.7, 0.1), Cell::kOccupied);
  const auto toStarboard = [](float range) { return Scan{-0.5 * kPi, 0.1, 0.2, 15.0, {range}}; };
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(insert(map, sensorAt(0.0, 0.1, 0.5 * kPi), toStarboard(0.6F)));
    EXPECT_EQ(cellAt(map, 0.7, 0.1), Cell::kOccupied) << k;
  }
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(insert(map, sensorAt(0.0, 0.1, 0.5 * kPi), toStarboard(kInf)));
  }
  EXPECT_EQ(cellAt(map, 0.7, 0.1), Cell::kFree);
}

TEST(OccupancyMap, MalformedScansAreRefusedWithAReason) {
  OccupancyMap map(coast(), kHull, kOptions);
  const auto reason = [&](const SensorPose& sensor, const Scan& scan) {
    const auto result = insert(map, sensor, scan);
    return result ? std::string() : result.error().message;
  };
  const auto expect = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(reason(sensorAt(kNan, 0.0), openWater()), "pose");
  expect(reason(sensorAt(500.0, 0.0), openWater()), "outside the map");
  expect(reason(sensorAt(0.0, 0.0), openWater(0)), "no ranges");
  expect(reason(sensorAt(0.0, 0.0), {0.0, kNan, 0.2, 15.0, {1.0F, 2.0F}}), "angle");
  expect(reason(sensorAt(0.0, 0.0), {0.0, 1.0, 0.2, 15.0, std::vector<float>(9, 1.0F)}), "round");
  expect(reason(sensorAt(0.0, 0.0), {0.0, 0.1, 5.0, 2.0, {1.0F}}), "range_min");
  expect(reason(sensorAt(0.0, 0.0), {0.0, 0.1, 0.2, 15.0, {3.0F, -1.0F}}), "range 1 is negative");
  EXPECT_EQ(map.projection().cells, coast().cells);
}

// Where a level beam crosses lines of the grid, along it, in order.
std::vector<double> linesCrossed(const GridGeometry& grid, const Eigen::Vector2d& from,
                                 const Eigen::Vector2d& along) {
  std::vector<double> lines;
  for (int axis = 0; axis < 2; ++axis) {
    for (int k = 0; k <= grid.width; ++k) {
      lines.push_back((grid.origin[axis] + k * grid.resolution_m - from[axis]) / along[axis]);
    }
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

// Columns that a level beam crosses: one for each stretch between two lines of the grid.
std::set<std::pair<int, int>> crossed(const GridGeometry& grid, const Eigen::Vector2d& from,
                                      const Eigen::Vector2d& along, double length) {
  std::vector<double> lines = linesCrossed(grid, from, along);
  lines.insert(lines.end(), {0.0, length});
  std::sort(lines.begin(), lines.end());
  std::set<std::pair<int, int>> cells;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const double middle = 0.5 * (lines[i - 1] + lines[i]);
    if (middle > 0.0 && middle < length) {
      const Eigen::Vector2i cell = grid.cellAt(from + middle * along);
      cells.emplace(cell.x(), cell.y());
    }
  }
  return cells;
}

constexpr double kRangeErrorM = 0.03;

// How many lines of the grid a beam crosses near its echo.
int facesWithin(const GridGeometry& grid, const SensorPose& sensor, const Scan& scan, std::size_t i,
                double error_m) {
  const Eigen::Vector2d along = (sensor.rotation() * scan.direction(i)).head<2>();
  const std::vector<double> lines = linesCrossed(grid, sensor.position.head<2>(), along);
  return static_cast<int>(std::count_if(lines.begin(), lines.end(), [&](double at) {
    return std::abs(at - scan.ranges_m[i]) < error_m;
  }));
}

// Scan by scan what a plain OctoMap holds that is told of each voxel once, hits before misses,
// where no echo lies at more than one face.
TEST(OccupancyMap, BelievesWhatAnOctoMapWould) {
  Random random(5);
  OccupancyGrid chart = coast();
  chart.cells.assign(chart.cells.size(), Cell::kUnknown);
  const GridGeometry& grid = chart.geometry;
  OccupancyMapOptions options;
  options.band = {0.75, 1.0};
  OccupancyMap map(chart, kHull, options);
  octomap::OcTree tree(grid.resolution_m);
  tree.setClampingThresMin(OccupancyMapOptions::kMinProbability);
  tree.setClampingThresMax(OccupancyMapOptions::kMaxProbability);
  const auto keyOf = [&](const std::pair<int, int>& cell) {
    const Eigen::Vector2d at = grid.centreOf(cell.first, cell.second);
    return tree.coordToKey(at.x(), at.y(), 0.875);
  };
  for (int k = 0; k < 60; ++k) {
    const SensorPose sensor =
        sensorAt(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    Scan scan = openWater(90);
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      float& range = scan.ranges_m[i];
      do {
        range = random.uniform() < 0.4 ? kInf : static_cast<float>(random.uniform(0.5, 12.0));
      } while (scan.metSomething(i) && facesWithin(grid, sensor, scan, i, kRangeErrorM) > 1);
    }
    ASSERT_TRUE(map.insertScan(sensor, {{-18.0, -18.0}, 0.0}, scan));
    std::set<std::pair<int, int>> hits, misses;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const Eigen::Vector2d along = (sensor.rotation() * scan.direction(i)).head<2>();
      const Eigen::Vector2d from = sensor.position.head<2>();
      const bool met = scan.metSomething(i);
      if (met) {
        const Eigen::Vector2i cell = grid.cellAt(from + (scan.ranges_m[i] + kRangeErrorM) * along);
        hits.emplace(cell.x(), cell.y());
      }
      misses.merge(
          crossed(grid, from, along, met ? scan.ranges_m[i] - kRangeErrorM : scan.range_max_m));
    }
    for (const auto& cell : hits) {
      tree.updateNode(keyOf(cell), octomap::logodds(options.hit_probability));
      misses.erase(cell);
    }
    for (const auto& cell : misses) {
      tree.updateNode(keyOf(cell), octomap::logodds(options.miss_probability));
    }
    if (k == 30) {
      map.reset();
      tree.clear();
    }
  }
  const std::string path = testing::TempDir() + "/believes.ot";
  ASSERT_TRUE(map.save(path));
  const std::unique_ptr<octomap::AbstractOcTree> saved(octomap::AbstractOcTree::read(path));
  std::filesystem::remove(path);
  const auto* ours = dynamic_cast<const octomap::OcTree*>(saved.get());
  ASSERT_NE(ours, nullptr);
  int seen = 0;
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const octomap::OcTreeKey key = keyOf({column, row});
      const octomap::OcTreeNode* wanted = tree.search(key);
      const octomap::OcTreeNode* is = ours->search(key);
      ASSERT_EQ(is != nullptr, wanted != nullptr) << column << ", " << row;
      if (wanted != nullptr) {
        ++seen;
        EXPECT_NEAR(is->getLogOdds(), wanted->getLogOdds(), 1e-5) << column << ", " << row;
        EXPECT_EQ(map.projection().at(column, row) == Cell::kOccupied,
                  wanted->getOccupancy() >= options.occupied_probability);
      }
    }
  }
  EXPECT_GT(seen, 8000);
}

// 20 m by 20 m in cells of 0.1 m.
OccupancyGrid pond() {
  OccupancyGrid grid;
  grid.geometry = {200, 200, 0.1, {-10.0, -10.0}};
  grid.cells.assign(200UL * 200UL, Cell::kUnknown);
  return grid;
}

// Pillars made of cells, as many of their corners are clipped by beams that come out a few
// centimetres on: they grow by hardly a cell, and none of them is taken for water.
TEST(OccupancyMap, PillarsDoNotGrowWhereBeamsClipTheirCorners) {
  Random random(8);
  const GridGeometry grid = pond().geometry;
  OccupancyGrid world = pond();
  std::vector<Eigen::Vector2d> pillars;
  for (int k = 0; k < 12; ++k) {
    pillars.emplace_back(random.uniform(-8.0, 8.0), random.uniform(1.5, 8.0));
  }
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      for (const Eigen::Vector2d& pillar : pillars) {
        if ((grid.centreOf(column, row) - pillar).norm() < 0.22) {
          world.cells[grid.index(column, row)] = Cell::kOccupied;
        }
      }
    }
  }
  OccupancyMap map(pond(), kHull, kOptions);
  for (double x = -6.0; x < 6.0; x += 0.1) {
    const SensorPose sensor = sensorAt(x, 0.0, 0.1 * random.normal());
    Scan scan = openWater();
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const Eigen::Vector2d along = (sensor.rotation() * scan.direction(i)).head<2>();
      for (const double at : linesCrossed(grid, sensor.position.head<2>(), along)) {
        const Eigen::Vector2d behind = sensor.position.head<2>() + (at + 1e-6) * along;
        if (at > 0.0 && grid.contains(behind) &&
            world.cells[grid.index(grid.cellAt(behind).x(), grid.cellAt(behind).y())] ==
                Cell::kOccupied) {
          scan.ranges_m[i] = static_cast<float>(at + 0.01 * random.normal());
          break;
        }
      }
    }
    ASSERT_TRUE(insert(map, sensor, scan));
  }
  int right = 0, grown = 0, lost = 0;
  for (std::size_t i = 0; i < world.cells.size(); ++i) {
    const bool there = world.cells[i] == Cell::kOccupied;
    const Cell seen = map.projection().cells[i];
    right += there && seen == Cell::kOccupied;
    grown += !there && seen == Cell::kOccupied;
    lost += there && seen == Cell::kFree;
  }
  EXPECT_GT(right, 6 * 12);
  EXPECT_LT(grown, 6);
  EXPECT_EQ(lost, 0);
}

// A beam that clips a cell's corner, 11 mm long, with its echo at 7 mm: by itself it comes from the
// cell behind, but not where the first is known.
TEST(OccupancyMap, AnEchoBetweenTwoFacesIsOfTheObstacleThatIsKnown) {
  constexpr double kCellM = 0.1;
  constexpr double kBesideM = 0.008;
  const Eigen::Vector2d corner(5.0, 1.0);  // of the cell to the right and below
  for (const bool known : {false, true}) {
    OccupancyMap map(pond(), kHull, kOptions);
    if (known) {
      ASSERT_TRUE(insert(map, sensorAt(2.0, corner.y() - 0.5 * kCellM), aheadOnly(3.0F)));
    }
    const Eigen::Vector2d enters = corner - Eigen::Vector2d(0.0, kBesideM);
    const float range = static_cast<float>(3.0 * std::sqrt(2.0) + 0.007);
    ASSERT_TRUE(
        insert(map, sensorAt(enters.x() - 3.0, enters.y() - 3.0, 0.25 * kPi), aheadOnly(range)));
    EXPECT_EQ(cellAt(map, corner.x() + 0.5 * kCellM, corner.y() - 0.5 * kCellM) == Cell::kOccupied,
              known);
    EXPECT_EQ(cellAt(map, corner.x() + 0.5 * kCellM, corner.y() + 0.5 * kCellM) == Cell::kOccupied,
              !known);
  }
}

// All echoes of it lie near two faces, and in each of the four cells other beams pass beside it.
TEST(OccupancyMap, SeesAThinPostWhereFourCellsMeet) {
  constexpr double kRadiusM = 0.015;
  OccupancyMap map(pond(), kHull, kOptions);
  const Eigen::Vector2d post(4.0, 4.0);
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(insert(map, sensorAt(0.0, 0.0), openWater()));
  }
  for (int k = 0; k < 8; ++k) {
    const SensorPose sensor = sensorAt(0.02 * k, 0.02 * k);
    Scan scan = openWater(2880);
    int echoes = 0;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const Eigen::Vector2d along = scan.direction(i).head<2>();
      const Eigen::Vector2d to = post - sensor.position.head<2>();
      const double beside = to.x() * along.y() - to.y() * along.x();
      if (to.dot(along) > 0.0 && std::abs(beside) < kRadiusM) {
        scan.ranges_m[i] =
            static_cast<float>(to.dot(along) - std::sqrt(kRadiusM * kRadiusM - beside * beside));
        ++echoes;
      }
    }
    ASSERT_GT(echoes, 0);
    ASSERT_TRUE(insert(map, sensor, scan));
  }
  int occupied = 0;
  for (const double x : {3.95, 4.05}) {
    for (const double y : {3.95, 4.05}) {
      occupied += cellAt(map, x, y) == Cell::kOccupied;
    }
  }
  EXPECT_GT(occupied, 0);
}

// What beams tell of one layer is nothing to the layers over and under it, nor to columns beside.
TEST(OccupancyMap, LayersAreBelievedApart) {
  OccupancyMap map(coast(), kHull, kOptions);
  const auto sensorOver = [](double z_m) { return SensorPose{{0.0, 0.125, z_m}, 0.0, 0.0, 0.0}; };
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(insert(map, sensorOver(0.7), aheadOnly(5.1F)));
  }
  ASSERT_TRUE(insert(map, sensorOver(1.2), aheadOnly(kInf)));
  const std::string path = testing::TempDir() + "/layers.ot";
  ASSERT_TRUE(map.save(path));
  const std::unique_ptr<octomap::AbstractOcTree> saved(octomap::AbstractOcTree::read(path));
  std::filesystem::remove(path);
  const auto* tree = dynamic_cast<const octomap::OcTree*>(saved.get());
  ASSERT_NE(tree, nullptr);
  const float hit = octomap::logodds(kOptions.hit_probability);
  const float miss = octomap::logodds(kOptions.miss_probability);
  const auto logOdds = [&](double x, int layer) {
    const octomap::OcTreeNode* node = tree->search(x, 0.125, 0.225 + 0.25 * layer);
    return node == nullptr ? kNan : node->getLogOdds();
  };
  for (int layer = 1; layer < 7; ++layer) {  // the lowest holds the chart
    if (layer != 2 && layer != 4) {
      EXPECT_TRUE(std::isnan(logOdds(5.125, layer))) << layer;
    }
  }
  EXPECT_NEAR(logOdds(5.125, 2), 2.0F * hit, 1e-5);
  EXPECT_NEAR(logOdds(5.125, 4), miss, 1e-5);
  EXPECT_NEAR(logOdds(4.125, 2), 2.0F * miss, 1e-5);
  EXPECT_TRUE(std::isnan(logOdds(7.125, 2)));
  EXPECT_NEAR(logOdds(7.125, 4), miss, 1e-5);
}

// A beam that sinks ahead frees each column where it passes, and no other layer of it.
TEST(OccupancyMap, ASlantingBeamPassesFromLayerToLayer) {
  constexpr double kBowDownRad = 0.1;
  OccupancyMap map(coast(), kHull, kOptions);
  const SensorPose sensor{{0.0, 0.125, 1.2}, 0.0, kBowDownRad, 0.0};
  ASSERT_TRUE(insert(map, sensor, aheadOnly(kInf)));
  const std::string path = testing::TempDir() + "/slanting.ot";
  ASSERT_TRUE(map.save(path));
  const std::unique_ptr<octomap::AbstractOcTree> saved(octomap::AbstractOcTree::read(path));
  std::filesystem::remove(path);
  const auto* tree = dynamic_cast<const octomap::OcTree*>(saved.get());
  ASSERT_NE(tree, nullptr);
  for (const double x : {0.125, 1.125, 4.125, 7.125}) {
    const int passed = static_cast<int>((1.2 - x * std::tan(kBowDownRad) - 0.1) / 0.25);
    for (int layer = 1; layer < 7; ++layer) {  // the lowest holds the chart
      EXPECT_EQ(tree->search(x, 0.125, 0.225 + 0.25 * layer) != nullptr, layer == passed)
          << x << ", " << layer;
    }
  }
}

TEST(OccupancyMap, SavesAndResets) {
  OccupancyMap map(coast(), kHull, kOptions);
  ASSERT_TRUE(insert(map, sensorAt(0.0, 0.0), aheadOnly(5.1F)));
  const std::vector<Cell> seen = map.projection().cells;
  ASSERT_NE(seen, coast().cells);
  for (const std::string ending : {".bt", ".ot", ".yaml"}) {
    const std::string path = testing::TempDir() + "/occupancy_map_test" + ending;
    const Status saved = map.save(path);
    ASSERT_TRUE(saved) << saved.error().message;
    const auto again = loadMap(path, kOptions.band);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->cells, seen) << ending;
    EXPECT_LT((again->geometry.origin - coast().geometry.origin).norm(), 1e-9) << ending;
    std::filesystem::remove(path);
  }
  EXPECT_FALSE(map.save(OTTER_NAV_SOURCE_DIR "/package.xml/map.bt"));
  EXPECT_FALSE(map.save("map.jpg"));
  const CellRectangle changed = map.reset();
  EXPECT_EQ(changed.width, 1);
  EXPECT_EQ(map.projection().cells, coast().cells);
}

// UTM's coordinates are out of a tree's reach: there it would be saved as another place's.
TEST(OccupancyMap, SavesWhatATreeCannotReachAsAChartOnly) {
  OccupancyGrid chart = coast();
  chart.geometry.origin = {569000.0, 7030000.0};
  OccupancyMap map(chart, kHull, kOptions);
  for (const std::string ending : {".bt", ".ot"}) {
    const std::string path = testing::TempDir() + "/utm" + ending;
    const Status saved = map.save(path);
    ASSERT_FALSE(saved) << ending;
    EXPECT_FALSE(std::filesystem::exists(path)) << ending;
    for (const std::string named : {path.c_str(), "569000", "7030000", "[-8192, 8192]", ".yaml"}) {
      EXPECT_NE(saved.error().message.find(named), std::string::npos) << saved.error().message;
    }
  }
  const std::string path = testing::TempDir() + "/utm.yaml";
  ASSERT_TRUE(map.save(path));
  const auto again = loadMap(path, kOptions.band);
  std::filesystem::remove(path);
  std::filesystem::remove(testing::TempDir() + "/utm.pgm");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->geometry, chart.geometry);
  EXPECT_EQ(again->cells, chart.cells);
}

// To a tree's very edge.
TEST(OccupancyMap, SavesWhatATreeJustReaches) {
  OccupancyGrid chart = coast();
  for (const double edge_m : {-8192.0, 8192.0 - 40.0}) {
    chart.geometry.origin.setConstant(edge_m);
    const OccupancyMap map(chart, kHull, kOptions);
    const std::string path = testing::TempDir() + "/edge.bt";
    ASSERT_TRUE(map.save(path)) << edge_m;
    const auto again = loadMap(path, kOptions.band);
    std::filesystem::remove(path);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->geometry, chart.geometry) << edge_m;
  }
}

TEST(LoadOctomap, BrokenFilesAreNamed) {
  OccupancyMap map(coast(), kHull, kOptions);
  for (const std::string ending : {".bt", ".ot"}) {
    const std::string path = testing::TempDir() + "/broken_octomap" + ending;
    ASSERT_TRUE(map.save(path));
    const auto size = std::filesystem::file_size(path);
    const auto message = [&] {
      const auto loaded = loadMap(path, kOptions.band);
      return loaded ? std::string() : loaded.error().message;
    };
    for (const auto cut : {size - 1, size / 2, std::uintmax_t{300}, std::uintmax_t{60}}) {
      std::filesystem::resize_file(path, cut);
      EXPECT_NE(message().find(path), std::string::npos) << cut;
    }
    std::ofstream(path) << "nonsense";
    EXPECT_NE(message().find("not an OctoMap file"), std::string::npos);
    std::filesystem::remove(path);
    EXPECT_NE(message().find("no such file"), std::string::npos);
  }
  EXPECT_FALSE(loadMap("chart.jpg", kOptions.band));
}

TEST(OccupancyMapOptions, ShippedFileHoldsTheDefaults) {
  const std::string path = std::string(OTTER_NAV_SOURCE_DIR) + "/config/map.yaml";
  const auto options = loadOccupancyMapOptions(path);
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(config::toYaml(*options), config::toYaml(kOptions));
  YAML::Node wrong = config::loadFile(path).value();
  wrong["band_min_m"] = 3.0;
  const auto refused = readOccupancyMapOptions({wrong, path});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("'band_min_m'"), std::string::npos);
}

}  // namespace
}  // namespace otter_nav::map
