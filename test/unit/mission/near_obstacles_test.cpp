#include "otter_nav/mission/near_obstacles.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "otter_nav/vessel/hull.hpp"
#include "waters.hpp"

namespace otter_nav::mission {
namespace {

constexpr std::size_t kMany = 1000;

// North of a wall whose face lies along y = -2.
map::DistanceField alongAWall() {
  map::OccupancyGrid water = test::openWater();
  test::block(water, {-40.0, -6.0}, {40.0, -2.1});
  return test::fieldOf(water);
}

vessel::Foreseen eastwardFrom(const Eigen::Vector2d& from, double length_m) {
  vessel::Foreseen foreseen{0.0, 0.15, {}};
  for (int k = 0; k <= 40; ++k) {
    foreseen.poses.push_back({from + Eigen::Vector2d(length_m * k / 40.0, 0.0), 0.0});
  }
  return foreseen;
}

TEST(NearObstacles, AreNoneInOpenWater) {
  const map::DistanceField field = alongAWall();
  const vessel::Pose here{{0.0, 1.0}, 0.0};
  EXPECT_TRUE(
      nearObstacles(field, vessel::Hull{}, here, eastwardFrom(here.position, 9.0), kMany).empty());
}

TEST(NearObstacles, AreOutlinesAlongTheWayThatIsForeseen) {
  const map::DistanceField field = alongAWall();
  const vessel::Hull hull;
  const vessel::Pose here{{0.0, -1.9 + 0.5 * hull.beam_m + 0.2}, 0.0};
  const auto still = nearObstacles(field, hull, here, {}, kMany);
  ASSERT_FALSE(still.empty());
  const auto under_way = nearObstacles(field, hull, here, eastwardFrom(here.position, 9.0), kMany);
  ASSERT_GT(under_way.size(), still.size());
  double farthest_m = 0.0;
  for (const Eigen::Vector2d& point : under_way) {
    EXPECT_NEAR(point.y(), -2.0, 1e-9);  // not what lies behind it
    EXPECT_EQ(field.clearance(point), 0.0);
    farthest_m = std::max(farthest_m, point.x());
  }
  EXPECT_GT(farthest_m, 9.0);
  EXPECT_LT(farthest_m, 9.0 + 0.5 * hull.length_m + 1.0);
  // Each once.
  auto sorted = under_way;
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x(); });
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    EXPECT_GT(sorted[k].x(), sorted[k - 1].x());
  }
}

TEST(NearObstacles, TheSoonestAreToldWhereThereAreTooMany) {
  const map::DistanceField field = alongAWall();
  const vessel::Hull hull;
  const vessel::Pose here{{0.0, -1.9 + 0.5 * hull.beam_m + 0.2}, 0.0};
  const auto still = nearObstacles(field, hull, here, {}, kMany);
  const auto few = nearObstacles(field, hull, here, eastwardFrom(here.position, 9.0), still.size());
  ASSERT_EQ(few.size(), still.size());
  for (std::size_t k = 0; k < few.size(); ++k) {
    EXPECT_EQ(few[k], still[k]);
  }
}

}  // namespace
}  // namespace otter_nav::mission
