// Invariants of both trees after any number of samples.
#include "planner/search.hpp"

#include <gtest/gtest.h>

#include "../../unit/planner/planner_ground.hpp"
#include "planner/sampler.hpp"

namespace otter_nav::planner {
namespace {

void expectSound(const Search& search, const Tree& tree) {
  for (int i = 1; i < tree.size(); ++i) {
    const Node& node = tree.node(i);
    ASSERT_TRUE(tree.isBelow(i, 0)) << i;
    EXPECT_NEAR(node.cost, tree.node(node.parent).cost + node.edge.cost, 1e-9);
    int seen = 0;
    for (int c = tree.node(node.parent).first_child; c != kNone; c = tree.node(c).next_sibling) {
      seen += c == i ? 1 : 0;
    }
    EXPECT_EQ(seen, 1) << i;
    std::vector<trajectory::Piece> pieces;
    search.appendEdge(tree, i, pieces);
    const KinoState& parent = tree.node(node.parent).state;
    const KinoState& from = tree.from(parent, node.state);
    const KinoState& to = tree.to(parent, node.state);
    double cost = 0.0;
    for (const auto& piece : pieces) {
      cost += pieceCost(piece, 1.0);
    }
    EXPECT_NEAR(cost, node.edge.cost, 1e-6 * cost);
    EXPECT_LT((pieces.front().flat(0.0).position - from.position).norm(), 1e-6);
    const auto end = pieces.back().flat(pieces.back().duration_s);
    EXPECT_LT((end.position - to.position).norm(), 1e-6);
    EXPECT_LT((end.velocity - to.velocity).norm(), 1e-6);
  }
}

TEST(Search, KeepsItsTreesSoundAndItsWaysContinuous) {
  const map::DistanceField field = test::withObstacle(-5.0, -12.0, 10.0, 24.0);
  const vessel::Parameters vessel;
  for (const bool repair : {false, true}) {
    SearchOptions options;
    options.sigma = 1.0;
    options.repair_edges = repair;
    Search search(options, vessel);
    KinoState start;
    start.position = {-25.0, 0.0};
    KinoState goal;
    goal.position = {25.0, 0.0};
    search.reset(field, feasibility::SafetyLimits{}, start, goal);
    GuideLine line;
    line.build({{-25.0, 0.0}, {0.0, 15.0}, {25.0, 0.0}}, field, vessel, GuideLineOptions{});
    Sampler sampler(SamplerOptions{}, line, field, 5);
    double cost = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 200; ++i) {
      search.extend(sampler.next());
      EXPECT_LE(search.bestCost(), cost + 1e-9);
      cost = search.bestCost();
    }
    expectSound(search, search.fromStart());
    expectSound(search, search.toGoal());
    ASSERT_TRUE(search.solved());
    const auto way = search.recall();
    double total = 0.0;
    for (std::size_t i = 0; i < way.size(); ++i) {
      total += pieceCost(way[i], 1.0);
      if (i > 0) {
        const auto before = way[i - 1].flat(way[i - 1].duration_s);
        const auto after = way[i].flat(0.0);
        EXPECT_LT((before.position - after.position).norm(), 1e-6);
        EXPECT_LT((before.velocity - after.velocity).norm(), 1e-6);
        EXPECT_LT((before.acceleration - after.acceleration).norm(), 1e-5);
      }
    }
    EXPECT_NEAR(total, search.bestCost(), 1e-6 * total);
    EXPECT_LE(search.counts().joined, search.counts().samples);
  }
}

}  // namespace
}  // namespace otter_nav::planner
