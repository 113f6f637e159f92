// Local optimisation bends a failing edge clear and leaves its end states alone.
#include "otter_nav/optimizer/local_optimizer.hpp"

#include <gtest/gtest.h>

namespace otter_nav::optimizer {
namespace {

map::DistanceField rockField() {
  map::OccupancyGrid grid;
  grid.geometry = {160, 160, 0.25, {0.0, 0.0}};
  grid.cells.assign(25600, map::Cell::kFree);
  for (int row = 78; row < 82; ++row) {
    for (int column = 78; column < 82; ++column) {
      grid.cells[grid.geometry.index(column, row)] = map::Cell::kOccupied;
    }
  }
  return map::DistanceField(grid, {});
}

trajectory::Piece edge(double y) {
  trajectory::Piece piece;
  piece.duration_s = 6.0;
  piece.position.col(0) = Eigen::Vector2d(11.0, y);
  piece.position.col(1) = Eigen::Vector2d(3.0, 0.0);
  return piece;
}

feasibility::EdgeCheck checkOn(const map::DistanceField& field) {
  feasibility::EdgeCheck check{vessel::Parameters()};
  check.begin(field, feasibility::SafetyLimits::of(vessel::Parameters()));
  return check;
}

TEST(LocalOptimizer, BendsAnEdgeAroundARock) {
  const LocalOptimizer local;
  const map::DistanceField field = rockField();
  const trajectory::Piece failing = edge(20.5);
  RepairedEdge repaired;
  ASSERT_TRUE(local.repair(checkOn(field), failing, 0.0, repaired));
  vessel::FlatPoint before = failing.flat(0.0);
  for (const trajectory::Piece& piece : repaired.pieces) {
    const vessel::FlatPoint at = piece.flat(0.0);
    EXPECT_LT((at.position - before.position).norm(), 1e-9);
    EXPECT_LT((at.velocity - before.velocity).norm(), 1e-9);
    EXPECT_LT((at.acceleration - before.acceleration).norm(), 1e-8);
    EXPECT_EQ(checkOn(field).checkBent(piece), feasibility::EdgeFault::kNone);
    before = piece.flat(piece.duration_s);
  }
  const vessel::FlatPoint end = failing.flat(failing.duration_s);
  EXPECT_LT((before.position - end.position).norm(), 1e-8);
  EXPECT_LT((before.velocity - end.velocity).norm(), 1e-8);
}

TEST(SquaredJerk, IsTheIntegral) {
  trajectory::Piece piece = edge(0.0);
  piece.position.col(3) = Eigen::Vector2d(0.1, -0.2);
  piece.position.col(5) = Eigen::Vector2d(0.01, 0.003);
  piece.position.col(7) = Eigen::Vector2d(-1e-4, 1e-4);
  constexpr int kSteps = 20000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    sum += piece.flat(piece.duration_s * (i + 0.5) / kSteps).jerk.squaredNorm();
  }
  EXPECT_NEAR(trajectory::squaredJerk(piece), sum * piece.duration_s / kSteps,
              1e-5 * trajectory::squaredJerk(piece));
}

}  // namespace
}  // namespace otter_nav::optimizer
