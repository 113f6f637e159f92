#include "archipelago/cylinder_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace otter_nav::scenario {
namespace {

using map::Cell;

TEST(CylinderField, IsAsNarrowAsAskedForAndCanBePassed) {
  const CylinderFieldOptions options;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto field = generateCylinderField(options, seed);
    ASSERT_TRUE(field) << field.error().message;
    EXPECT_GE(field->cylinders, options.fewest);
    EXPECT_LE(field->cylinders, options.most);
    const map::DistanceField distances(field->world, {2.0, false});
    const double best =
        widestWay(distances, field->mission.start.position, field->mission.goal.position);
    EXPECT_EQ(best, field->best_m);
    EXPECT_GE(best, options.best_min_m);
    EXPECT_LE(best, options.best_max_m);
    EXPECT_TRUE(std::all_of(field->chart.cells.begin(), field->chart.cells.end(),
                            [](Cell cell) { return cell == Cell::kUnknown; }));
    const map::GridGeometry& g = field->world.geometry;
    EXPECT_EQ(field->world.at(0, g.height / 2), Cell::kOccupied);
    EXPECT_EQ(field->world.at(g.width - 1, g.height / 2), Cell::kOccupied);
  }
}

TEST(CylinderField, IsTheSameForTheSameSeed) {
  const auto a = generateCylinderField({}, 3);
  const auto b = generateCylinderField({}, 3);
  const auto c = generateCylinderField({}, 4);
  ASSERT_TRUE(a && b && c);
  EXPECT_EQ(a->world.cells, b->world.cells);
  EXPECT_EQ(a->mission.goal.position, b->mission.goal.position);
  EXPECT_NE(a->world.cells, c->world.cells);
}

// A wall across with a gap 1 m wide: a place in it keeps half of that.
TEST(WidestWay, IsWhereTheBestWayIsNarrowest) {
  map::OccupancyGrid grid;
  grid.geometry = {100, 100, 0.1, {0.0, 0.0}};
  grid.cells.assign(10000, Cell::kFree);
  for (int column = 0; column < 100; ++column) {
    if (column < 40 || column >= 50) {
      grid.cells[grid.geometry.index(column, 50)] = Cell::kOccupied;
    }
  }
  EXPECT_NEAR(widestWay(map::DistanceField(grid, {5.0, false}), {2.0, 2.0}, {8.0, 8.0}), 0.5, 0.06);
  for (int column = 40; column < 50; ++column) {
    grid.cells[grid.geometry.index(column, 50)] = Cell::kOccupied;
  }
  EXPECT_EQ(widestWay(map::DistanceField(grid, {5.0, false}), {2.0, 2.0}, {8.0, 8.0}), 0.0);
}

}  // namespace
}  // namespace otter_nav::scenario
