#include "otter_nav/feasibility/edge_check.hpp"

#include <gtest/gtest.h>

#include "../planner/planner_ground.hpp"
#include "planner/obvp.hpp"

namespace otter_nav::feasibility {
namespace {

using planner::KinoState;
using planner::quinticPiece;

KinoState moving(double x, double y, double speed) {
  KinoState state;
  state.position = {x, y};
  state.velocity = {speed, 0.0};
  return state;
}

EdgeCheck makeCheck(const map::DistanceField& field) {
  EdgeCheck check{vessel::Parameters{}};
  check.begin(field, SafetyLimits::of(vessel::Parameters{}));
  return check;
}

TEST(EdgeCheck, PassesASteadyEdgeOnOpenWater) {
  const map::DistanceField field = planner::test::openWater();
  const auto piece = quinticPiece(moving(-10, 0, 4), moving(10, 0, 4), 5.0);
  EXPECT_EQ(makeCheck(field).check(piece), EdgeFault::kNone);
}

TEST(EdgeCheck, NamesWhatFails) {
  const map::DistanceField field = planner::test::openWater();
  const EdgeCheck check = makeCheck(field);
  EXPECT_EQ(check.check(quinticPiece(moving(-10, 0, 4), moving(10, 0, 4), 3.0)), EdgeFault::kSpeed);
  EXPECT_EQ(check.check(quinticPiece(moving(0, 0, 4), moving(2, 0, 0), 1.0)), EdgeFault::kForce);
}

TEST(EdgeCheck, SeesAnObstacleThinnerThanItsSteps) {
  // One cell of 0.25 m, met at 4 m/s: 0.06 s.
  const map::DistanceField field = planner::test::withObstacle(0.0, 0.0, 0.25, 0.25);
  const EdgeCheck check = makeCheck(field);
  EXPECT_EQ(check.check(quinticPiece(moving(-10, 0, 4), moving(10, 0, 4), 5.0)),
            EdgeFault::kClearance);
  // Beside it with the clearance asked for, and a little less.
  EXPECT_EQ(check.check(quinticPiece(moving(-10, -0.95, 4), moving(10, -0.95, 4), 5.0)),
            EdgeFault::kNone);
  EXPECT_EQ(check.check(quinticPiece(moving(-10, -0.75, 4), moving(10, -0.75, 4), 5.0)),
            EdgeFault::kClearance);
}

}  // namespace
}  // namespace otter_nav::feasibility
