#include "otter_nav/topology/guide_path.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <queue>

#include "../map/random_grid.hpp"
#include "otter_nav/base/angles.hpp"

namespace otter_nav::topology {
namespace {

using map::DistanceField;
using map::OccupancyGrid;

constexpr int kSide = 120;  // cells

// The shortest way in steps from corner to neighbouring corner, each clear: infinite if there is
// none. A shortest any-angle path is at most as long.
double latticeLength(const DistanceField& field, const Eigen::Vector2i& start,
                     const Eigen::Vector2i& goal, double clearance_m) {
  const int width = field.geometry().width + 1;
  std::vector<double> length(static_cast<std::size_t>(width) * static_cast<std::size_t>(width),
                             std::numeric_limits<double>::infinity());
  const auto at = [&](const Eigen::Vector2i& c) -> double& {
    return length[static_cast<std::size_t>(c.y() * width + c.x())];
  };
  const auto position = [&](const Eigen::Vector2i& c) -> Eigen::Vector2d {
    return field.geometry().origin + field.geometry().resolution_m * c.cast<double>();
  };
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  at(start) = 0.0;
  open.emplace(0.0, start.y() * width + start.x());
  while (!open.empty()) {
    const auto [so_far, id] = open.top();
    open.pop();
    const Eigen::Vector2i here(id % width, id / width);
    if (so_far > at(here)) {
      continue;
    }
    if (here == goal) {
      return so_far;
    }
    for (int k = 0; k < 9; ++k) {
      const Eigen::Vector2i next = here + Eigen::Vector2i(k % 3 - 1, k / 3 - 1);
      if (next.minCoeff() < 0 || next.maxCoeff() >= width) {
        continue;
      }
      const double total = so_far + (position(next) - position(here)).norm();
      if (total < at(next) &&
          map::segmentIsClear(field, position(here), position(next), clearance_m)) {
        at(next) = total;
        open.emplace(total, next.y() * width + next.x());
      }
    }
  }
  return std::numeric_limits<double>::infinity();
}

struct Task {
  Pose start, goal;
  Eigen::Vector2i start_corner, goal_corner;
};

Task randomTask(Random& random, const DistanceField& field) {
  const auto corner = [&] {
    Eigen::Vector2i c(0, 0);
    while (field.cornerClearance(c.x(), c.y()) < 1.0) {
      c = {map::randomBelow(random, kSide), map::randomBelow(random, kSide)};
    }
    return c;
  };
  Task task;
  task.start_corner = corner();
  task.goal_corner = corner();
  const auto position = [&](const Eigen::Vector2i& c) -> Eigen::Vector2d {
    return field.geometry().origin + field.geometry().resolution_m * c.cast<double>();
  };
  task.start = {position(task.start_corner), random.uniform(-kPi, kPi)};
  task.goal = {position(task.goal_corner), random.uniform(-kPi, kPi)};
  return task;
}

TEST(GuidePathProperty, ClearNearShortestAndFoundWheneverThereIsAWay) {
  Random random(11);
  GuidePathFinder finder({});
  GuidePath path;
  int ways = 0;
  int none = 0;
  for (int round = 0; round < 60; ++round) {
    const OccupancyGrid grid = map::randomGrid(random, kSide, kSide, 20 + 5 * (round % 40));
    const DistanceField field(grid, {});
    const Task task = randomTask(random, field);
    const double strict = latticeLength(field, task.start_corner, task.goal_corner, 0.82);
    const auto found = finder.find(field, task.start, task.goal, path);
    if (!found) {
      ++none;
      ASSERT_EQ(found.error().failure, Failure::kNoPath);
      ASSERT_TRUE(std::isinf(strict)) << "round " << round;
      continue;
    }
    ++ways;
    ASSERT_EQ(path.points.front(), task.start.position);
    ASSERT_EQ(path.points.back(), task.goal.position);
    ASSERT_EQ(path.points.size(), path.corridor_m.size());
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      for (int k = 0; k <= 8; ++k) {
        const Eigen::Vector2d p =
            path.points[i - 1] + (path.points[i] - path.points[i - 1]) * (0.125 * k);
        ASSERT_GE(map::bruteForceClearance(grid, p), 0.8 - 1e-9) << "round " << round;
      }
    }
    if (std::isfinite(strict)) {
      ASSERT_LE(path.length_m, 1.01 * strict) << "round " << round;
    }
    // With a cell's less clearance the steps get through wherever a straight line does.
    const double loose = latticeLength(field, task.start_corner, task.goal_corner, 0.55);
    ASSERT_GE(path.length_m, 0.92 * loose) << "round " << round;
  }
  EXPECT_GT(ways, 20);
  EXPECT_GT(none, 3);
}

TEST(GuidePathProperty, SameInputsGiveTheSamePath) {
  Random random(12);
  GuidePathFinder used({});
  for (int round = 0; round < 15; ++round) {
    const DistanceField field(map::randomGrid(random, kSide, kSide, 40), {});
    const Task task = randomTask(random, field);
    GuidePathFinder fresh({});
    const auto first = used.find(field, task.start, task.goal);
    const auto second = fresh.find(field, task.start, task.goal);
    ASSERT_EQ(first.has_value(), second.has_value());
    if (first) {
      ASSERT_EQ(first->points, second->points);
    }
  }
}

}  // namespace
}  // namespace otter_nav::topology
