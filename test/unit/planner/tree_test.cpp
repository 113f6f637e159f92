#include "planner/tree.hpp"

#include <gtest/gtest.h>

namespace otter_nav::planner {
namespace {

KinoState at(double x) {
  KinoState state;
  state.position = {x, 0.0};
  return state;
}

Edge costing(double cost) {
  Edge edge;
  edge.cost = cost;
  edge.duration_s = cost;
  return edge;
}

TEST(Tree, SumsCostsAlongTheWay) {
  Tree tree(Direction::kFromRoot, 8);
  tree.reset(at(0.0));
  const int a = tree.add(at(1.0), 0, costing(2.0));
  const int b = tree.add(at(2.0), a, costing(3.0));
  EXPECT_DOUBLE_EQ(tree.node(b).cost, 5.0);
  EXPECT_TRUE(tree.isBelow(b, 0));
  EXPECT_FALSE(tree.isBelow(a, b));
}

TEST(Tree, RewiringPassesTheSavingDown) {
  Tree tree(Direction::kFromRoot, 8);
  tree.reset(at(0.0));
  const int a = tree.add(at(1.0), 0, costing(9.0));
  const int b = tree.add(at(2.0), a, costing(3.0));
  const int c = tree.add(at(3.0), b, costing(1.0));
  const int sibling = tree.add(at(4.0), a, costing(1.0));
  const int short_cut = tree.add(at(5.0), 0, costing(1.0));
  tree.rewire(b, short_cut, costing(2.0));
  EXPECT_DOUBLE_EQ(tree.node(b).cost, 3.0);
  EXPECT_DOUBLE_EQ(tree.node(c).cost, 4.0);
  EXPECT_DOUBLE_EQ(tree.node(sibling).cost, 10.0);
  EXPECT_EQ(tree.node(b).parent, short_cut);
  EXPECT_TRUE(tree.isBelow(c, short_cut));
  EXPECT_FALSE(tree.isBelow(c, a));
  EXPECT_EQ(tree.node(a).first_child, sibling);
  EXPECT_EQ(tree.node(sibling).next_sibling, kNone);
}

TEST(Tree, KnowsWhichWayItsEdgesAreSailed) {
  const Tree from_start(Direction::kFromRoot, 2);
  const Tree to_goal(Direction::kToRoot, 2);
  const KinoState parent = at(0.0);
  const KinoState child = at(1.0);
  EXPECT_EQ(&from_start.from(parent, child), &parent);
  EXPECT_EQ(&to_goal.from(parent, child), &child);
}

TEST(Tree, IsFullAtItsCapacity) {
  Tree tree(Direction::kToRoot, 2);
  tree.reset(at(0.0));
  EXPECT_FALSE(tree.full());
  tree.add(at(1.0), 0, costing(1.0));
  EXPECT_TRUE(tree.full());
}

}  // namespace
}  // namespace otter_nav::planner
