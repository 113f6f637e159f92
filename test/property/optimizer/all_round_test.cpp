// How many ways one attempt of the global optimiser finds for the Otter, all round the compass: in
// a firm load, bow to it at both ends, and from a start that is too fast.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "otter_nav/base/angles.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/optimizer/global_optimizer.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr int kCourses = 24;

class AllRoundTest : public ::testing::Test {
 protected:
  AllRoundTest() {
    map::OccupancyGrid grid;
    grid.geometry = {400, 400, 0.5, {-100.0, -100.0}};
    grid.cells.assign(160000, map::Cell::kFree);
    field_ = map::DistanceField(grid, {});
  }

  // Verified ways of attempt number `attempt` alone.
  [[nodiscard]] int found(int attempt, const feasibility::SafetyLimits& limits, double way_m,
                          double start_mps) const {
    GlobalOptimizer optimizer(GlobalOptions(), vessel_);
    Budget budget;
    budget.first_attempt = attempt;
    budget.max_attempts = attempt + 1;
    int count = 0;
    for (int k = 0; k < kCourses; ++k) {
      const double course = 2.0 * kPi * k / kCourses;
      trajectory::Boundary start;
      start.psi_rad = start_mps > 0.0 ? course : kIntoLoadRad;
      start.flat.velocity = start_mps * unitVector(course);
      trajectory::Boundary goal;
      goal.flat.position = way_m * unitVector(course);
      goal.psi_rad = kIntoLoadRad;
      const auto result = optimizer.optimize(field_, {Eigen::Vector2d::Zero(), goal.flat.position},
                                             start, goal, budget, limits);
      count += result.has_value() ? 1 : 0;
    }
    return count;
  }

  [[nodiscard]] feasibility::SafetyLimits limits(double force_n) const {
    auto limits = feasibility::SafetyLimits::of(vessel_, 1.0, 0.7);
    limits.disturbance.force_n = {0.0, -force_n};
    return limits;
  }

 private:
  static constexpr double kIntoLoadRad = 0.5 * kPi;
  vessel::Parameters vessel_ =
      *vessel::loadParameters(std::string(OTTER_NAV_SOURCE_DIR) + "/config/vessels/otter.yaml");
  map::DistanceField field_;
};

// With |w| wanted as firmly from round to round 17 and 15 were found.
TEST_F(AllRoundTest, RoundsUpToTheGoal) {
  EXPECT_GE(found(0, limits(25.0), 70.0, 0.0), 20);
  EXPECT_GE(found(0, limits(30.0), 40.0, 0.0), 18);
}

TEST_F(AllRoundTest, TheMostCarefulAttemptFindsWaysToo) {
  for (const double force_n : {25.0, 30.0, 40.0}) {
    EXPECT_GE(found(3, limits(force_n), 40.0, 0.0), kCourses / 2) << force_n << " N";
  }
}

TEST_F(AllRoundTest, SlowsDownFromAStartThatIsTooFast) {
  for (const double speed_mps : {1.0, 1.48}) {
    feasibility::SafetyLimits slow = limits(0.0);
    slow.limitSpeed(speed_mps);
    EXPECT_EQ(found(0, slow, 40.0, 2.0), kCourses) << speed_mps << " m/s";
  }
}

}  // namespace
}  // namespace otter_nav::optimizer
