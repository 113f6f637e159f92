// Invariants of both trees after any number of samples.
#include "planner/search.hpp"

#include <gtest/gtest.h>

#include "../../unit/planner/planner_ground.hpp"
#include "planner/sampler.hpp"

namespace otter_nav::planner {
namespace {

void expectSound(const Search& search, const Tree& tree, double sigma) {
  for (int i = 1; i < tree.size(); ++i) {
    const Node& node = tree.node(i);
    ASSERT_TRUE(tree.isBelow(i, 0)) << i;
    EXPECT_NEAR(node.cost, tree.node(node.parent).cost + node.edge.cost, 1e-9);
    EXPECT_NEAR(node.time_s, tree.node(node.parent).time_s + node.edge.duration_s, 1e-9);
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
      cost += pieceCost(piece, sigma);
    }
    EXPECT_NEAR(cost, node.edge.cost, 1e-6 * cost);
    EXPECT_LT((pieces.front().flat(0.0).position - from.position).norm(), 1e-6);
    const auto end = pieces.back().flat(pieces.back().duration_s);
    EXPECT_LT((end.position - to.position).norm(), 1e-6);
    EXPECT_LT((end.velocity - to.velocity).norm(), 1e-6);
  }
}

int bentEdges(const Tree& tree) {
  int bent = 0;
  for (int i = 1; i < tree.size(); ++i) {
    bent += tree.node(i).edge.first_piece != kNone ? 1 : 0;
  }
  return bent;
}

TEST(Search, KeepsItsTreesSoundAndItsWaysContinuous) {
  map::OccupancyGrid grid = test::openGrid();
  test::fill(grid, -5.0, -12.0, 10.0, 24.0);
  for (const double x : {-22.0, -17.0, -12.0, 8.0, 13.0, 18.0}) {  // between samples
    test::fill(grid, x, 3.0, 1.0, 1.0);
    test::fill(grid, x + 2.0, 8.0, 1.0, 1.0);
  }
  const map::DistanceField field(grid, {});
  const vessel::Parameters vessel;
  int bent_in_all = 0;
  // Two prices of a second, so that a bent edge priced at another would show.
  for (const auto& [sigma, repair] : {std::pair(1.0, false), {1.0, true}, {1.5, true}}) {
    SearchOptions options;
    options.sigma = sigma;
    options.repair_edges = repair;
    Search search(options, vessel);
    KinoState start;
    start.position = {-25.0, 0.0};
    KinoState goal;
    goal.position = {25.0, 0.0};
    search.reset(field, feasibility::SafetyLimits::of(vessel), start, goal);
    GuideLineOptions guide;
    guide.speed_mps = 4.0;
    guide.force_ahead_n = 95.0;
    GuideLine line;
    line.build({{-25.0, 0.0}, {0.0, 15.0}, {25.0, 0.0}}, field, vessel, guide);
    SamplerOptions drawn;
    drawn.speed_max_mps = 4.7;
    Sampler sampler(drawn, line, field, 5);
    double cost = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 200; ++i) {
      search.extend(sampler.next());
      EXPECT_LE(search.bestCost(), cost + 1e-9);
      cost = search.bestCost();
    }
    expectSound(search, search.fromStart(), sigma);
    expectSound(search, search.toGoal(), sigma);
    const int bent = bentEdges(search.fromStart()) + bentEdges(search.toGoal());
    EXPECT_TRUE(repair || bent == 0);
    bent_in_all += bent;
    ASSERT_TRUE(search.solved());
    const auto way = search.recall();
    double total = 0.0;
    for (std::size_t i = 0; i < way.size(); ++i) {
      total += pieceCost(way[i], sigma);
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
  EXPECT_GT(bent_in_all, 0);
}

// A small disc that moves north and is at `where` at time `when_s`.
class Crossing : public feasibility::ObstacleLayer {
 public:
  Crossing(const Eigen::Vector2d& where, double when_s) : where_(where), when_s_(when_s) {}
  [[nodiscard]] double clearance(const Eigen::Vector2d& p, double time_s) const override {
    return std::max(0.0, smooth(p, time_s).distance_m);
  }
  [[nodiscard]] double rateBound() const override { return kSpeedMps; }
  [[nodiscard]] map::DistanceField::Smooth smooth(const Eigen::Vector2d& p,
                                                  double time_s) const override {
    const Eigen::Vector2d off = p - where_ - Eigen::Vector2d(0.0, kSpeedMps * (time_s - when_s_));
    return {off.norm() - 0.5, off.normalized()};
  }

 private:
  static constexpr double kSpeedMps = 2.0;
  Eigen::Vector2d where_;
  double when_s_;
};

TEST(Search, TheStartsTreeMeetsWhatMovesWhereItWillBeByThen) {
  const map::DistanceField field = test::openWater();
  KinoState start;
  start.position = {-25.0, 0.0};
  KinoState goal;
  goal.position = {30.0, 30.0};
  KinoState first;
  first.position = {-12.0, 0.0};
  first.velocity = {3.0, 0.0};
  KinoState second;
  second.position = {5.0, 0.0};
  second.velocity = {3.0, 0.0};
  SearchOptions options;
  options.sigma = 1.0;
  options.repair_edges = false;
  Search search(options, vessel::Parameters{});
  const auto grow = [&](const feasibility::Obstacles& obstacles) -> const Tree& {
    search.reset(obstacles, feasibility::SafetyLimits::of(vessel::Parameters{}), start, goal);
    search.extend(first);
    search.extend(second);
    return search.fromStart();
  };
  const Tree& tree = grow(field);
  ASSERT_EQ(tree.size(), 3);
  ASSERT_EQ(tree.node(2).parent, 1);
  std::vector<trajectory::Piece> edge;
  search.appendEdge(tree, 2, edge);
  const double half_s = 0.5 * edge.front().duration_s;
  ASSERT_GT(tree.node(1).time_s, 2.0);
  const Crossing met(edge.front().flat(half_s).position, tree.node(1).time_s + half_s);
  const Crossing missed(edge.front().flat(half_s).position, half_s);
  feasibility::Obstacles meeting(field);
  meeting.add(met);
  const Tree& barred = grow(meeting);
  EXPECT_FALSE(barred.size() == 3 && barred.node(2).parent == 1);
  feasibility::Obstacles passed(field);
  passed.add(missed);
  EXPECT_EQ(grow(passed).node(2).parent, 1);
}

}  // namespace
}  // namespace otter_nav::planner
