// Local optimisation bends a failing edge clear and leaves its end states alone.
#include "otter_nav/optimizer/local_optimizer.hpp"

#include <gtest/gtest.h>

#include "otter_nav/optimizer/global_optimizer.hpp"

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
  check.begin(field, feasibility::SafetyLimits());
  return check;
}

TEST(LocalOptimizer, BendsAnEdgeAroundARock) {
  const LocalOptimizer local{LocalOptions(), vessel::Parameters()};
  const map::DistanceField field = rockField();
  const trajectory::Piece failing = edge(20.5);
  RepairedEdge repaired;
  ASSERT_TRUE(local.repair(checkOn(field), failing, 0.0, repaired));
  ASSERT_GT(repaired.count, 1);
  vessel::FlatPoint before = failing.flat(0.0);
  for (int i = 0; i < repaired.count; ++i) {
    const trajectory::Piece& piece = repaired.pieces[static_cast<std::size_t>(i)];
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

TEST(OptimizerOptions, ShippedFileIsRead) {
  const auto node = config::loadFile(std::string(OTTER_NAV_SOURCE_DIR) + "/config/optimizer.yaml");
  ASSERT_TRUE(node.has_value());
  config::Section section(*node, "optimizer.yaml");
  const auto global = readGlobalOptions(section.child("global"));
  const auto local = readLocalOptions(section.child("local"));
  ASSERT_TRUE(global.has_value()) << global.error().message;
  ASSERT_TRUE(local.has_value()) << local.error().message;
  // The defaults in the code are those shipped.
  EXPECT_EQ(global->weight_smooth, GlobalOptions().weight_smooth);
  EXPECT_EQ(global->piece_length_m, GlobalOptions().piece_length_m);
  EXPECT_EQ(local->segments, LocalOptions().segments);
}

}  // namespace
}  // namespace otter_nav::optimizer
