// What lies where a hull that lost its heading is set to.
#include "otter_nav/feasibility/lee_shore.hpp"

#include <gtest/gtest.h>

#include "otter_nav/base/random.hpp"

namespace otter_nav::feasibility {
namespace {

using Eigen::Vector2d;

constexpr double kClearanceM = 1.5;
constexpr double kLeastM = 1.0;
const Vector2d kDrift(0.0, 5.0);  // to the north
const Vector2d kStart(-30.0, -30.0);
const Vector2d kGoal(30.0, -30.0);

// A bar of land along y = 0 to 2 m, from x = -10 to 10 m.
map::DistanceField water() {
  map::OccupancyGrid grid;
  grid.geometry = {200, 200, 0.5, {-50.0, -50.0}};
  grid.cells.assign(40000, map::Cell::kFree);
  for (int row = 100; row < 104; ++row) {
    for (int column = 80; column < 120; ++column) {
      grid.cells[grid.geometry.index(column, row)] = map::Cell::kOccupied;
    }
  }
  return map::DistanceField(grid, {});
}

LeeShore shoreOf(const map::DistanceField& field, const Vector2d& start = kStart) {
  return {field, kDrift, kLeastM, kClearanceM, start, kGoal};
}

TEST(LeeShore, CountsToLeewardAndNotToWindward) {
  const map::DistanceField field = water();
  const LeeShore lee = shoreOf(field);
  EXPECT_LT(lee.clearance({0.0, -5.5}, 0.0), kClearanceM);  // set onto the shore
  EXPECT_GE(lee.clearance({0.0, -6.5}, 0.0), kClearanceM);
  EXPECT_GE(lee.clearance({0.0, 3.5}, 0.0), kClearanceM);    // set off it
  EXPECT_GE(lee.clearance({15.0, -2.0}, 0.0), kClearanceM);  // past it
}

// What is between the ends of the drift isn't stepped over.
TEST(LeeShore, CountsAllTheWay) {
  const map::DistanceField field = water();
  const LeeShore lee = shoreOf(field);
  for (double y = -5.8; y < -1.1; y += 0.1) {
    EXPECT_LT(lee.clearance({0.0, y}, 0.0), kClearanceM) << y;
  }
}

TEST(LeeShore, AsksForNoMoreThanTheEndsHaveNearThem) {
  const map::DistanceField field = water();
  const Vector2d start(0.0, -2.5);
  const LeeShore lee = shoreOf(field, start);
  EXPECT_GE(lee.clearance(start, 0.0), kClearanceM);
  EXPECT_GE(lee.clearance(start - Vector2d(0.0, 2.0), 0.0), kClearanceM);  // on the way off it
  EXPECT_LT(lee.clearance(start + Vector2d(8.0, 0.0), 0.0), kClearanceM);  // along it
}

TEST(LeeShore, ChangesNoFasterThanThePosition) {
  const map::DistanceField field = water();
  Random random(1);
  for (const Vector2d& start : {kStart, Vector2d(0.0, -2.5)}) {
    const LeeShore lee = shoreOf(field, start);
    for (int k = 0; k < 20000; ++k) {
      const Vector2d a(random.uniform(-15.0, 15.0), random.uniform(-12.0, 6.0));
      const Vector2d b = a + Vector2d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
      constexpr double kLowerBoundM = 0.1;  // of the field's, against the exact distance
      EXPECT_LE(std::abs(lee.clearance(a, 0.0) - lee.clearance(b, 0.0)),
                (a - b).norm() + kLowerBoundM);
    }
  }
}

}  // namespace
}  // namespace otter_nav::feasibility
