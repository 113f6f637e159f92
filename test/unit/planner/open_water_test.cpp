// In open water the way is straight.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "otter_nav/planner/planner.hpp"

namespace otter_nav::planner {
namespace {

map::DistanceField openWater() {
  constexpr double kSideM = 500.0;
  constexpr int kCells = 1000;
  map::OccupancyGrid grid;
  grid.geometry = {kCells, kCells, kSideM / kCells, Eigen::Vector2d::Constant(-0.5 * kSideM)};
  grid.cells.assign(static_cast<std::size_t>(kCells) * kCells, map::Cell::kFree);
  return map::DistanceField(grid, map::DistanceFieldOptions{});
}

class OpenWaterTest : public ::testing::TestWithParam<const char*> {};

// At a speed limit, which holds all along, and without one.
TEST_P(OpenWaterTest, IsCrossedInAStraightLine) {
  constexpr double kAsideM = 0.5;
  const vessel::Parameters vessel = *vessel::loadParameters(
      std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/" + GetParam() + ".yaml");
  const map::DistanceField field = openWater();
  const feasibility::Obstacles obstacles(field);
  for (const double speed_max_mps : {0.8, 1.96, 100.0}) {
    for (const double length_m : {60.0, 200.0, 400.0}) {
      for (const double course_rad : {0.0, 0.7, 1.5707963267948966}) {
        SCOPED_TRACE(testing::Message() << length_m << " m at " << speed_max_mps
                                        << " m/s and less, course " << course_rad);
        const Eigen::Vector2d ahead(std::cos(course_rad), std::sin(course_rad));
        Query query;
        query.limits = feasibility::SafetyLimits::of(vessel, 1.6, 0.95);
        query.limits.limitSpeed(speed_max_mps);
        query.start.flat.position = -0.5 * length_m * ahead;
        query.start.psi_rad = course_rad + 0.01;
        query.goal.flat.position = 0.5 * length_m * ahead;
        query.goal.psi_rad = course_rad;
        Planner planner(Options{}, vessel);
        const Plan plan = planner.plan(obstacles, query, Termination{});
        ASSERT_EQ(plan.outcome, Outcome::kSolved) << plan.reason;
        double aside_m = 0.0;
        for (double t = 0.0; t < plan.trajectory.duration(); t += 0.1) {
          const Eigen::Vector2d p = plan.trajectory.flat(t).position;
          aside_m = std::max(aside_m, std::abs(ahead.x() * p.y() - ahead.y() * p.x()));
        }
        EXPECT_LT(aside_m, kAsideM);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Vessels, OpenWaterTest, ::testing::Values("otter_gazebo", "otter"));

}  // namespace
}  // namespace otter_nav::planner
