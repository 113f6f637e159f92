// The objective's derivatives against finite differences, its closed-form step against a dense
// solver.
#include "optimizer/objective/spline_problem.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "../feasibility/moving_disc.hpp"
#include "optimizer/solve/initial_spline.hpp"
#include "otter_nav/base/random.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kOff = 0.05;

map::DistanceField islandField() {
  map::OccupancyGrid grid;
  grid.geometry = {80, 80, 0.5, {-20.0, -20.0}};
  grid.cells.assign(6400, map::Cell::kFree);
  for (int row = 36; row < 44; ++row) {
    for (int column = 36; column < 44; ++column) {
      grid.cells[grid.geometry.index(column, row)] = map::Cell::kOccupied;
    }
  }
  return map::DistanceField(grid, {});
}

// Past an island's edge between fixed ends; every kind of term is at work.
Spline bentSpline(Random& random) {
  Spline spline;
  for (int k = 0; k < 5; ++k) {
    Knot knot;
    knot.state << -8.0 + 4.0 * k, 2.0, 0.3, 0.1, 2.2 + 0.3 * k, 0.4, 0.2, -0.1;
    for (int i = 0; i < 8; ++i) {
      knot.state(i % 2, i / 2) += kOff * random.normal();
    }
    spline.knots.push_back(knot);
  }
  spline.spans = {{1.2}, {1.6}, {1.5}, {1.4}};
  spline.knots.front().free = false;
  spline.knots.back().free = false;
  return spline;
}

class SplineProblemTest : public ::testing::Test {
 protected:
  SplineProblemTest() : problem(vessel::Parameters()) {
    problem.targets.obstacles = &obstacles;
    problem.targets.originals = &originals;
    problem.targets.weights = {1.0, 0.1, 0.01, 20.0, 20.0, 0.3, 0.7, 5.0};
    problem.targets.limits.thrust_ahead_n = 20.0;
    problem.targets.limits.thrust_astern_n = 10.0;
    problem.targets.limits.speed_mps = 2.0;
    problem.targets.limits.yaw_rate_radps = 0.05;
    problem.targets.limits.heading_force_n = 60.0;
    problem.targets.limits.clearance_m = 2.0;
    problem.targets.limits.hull_offset_m = 0.667;
    problem.targets.limits.hull_clearance_m = 1.8;
  }

  // By central differences, over a parameter of a knot.
  [[nodiscard]] double slopeOfTheCost(const Spline& spline, std::size_t knot, int row) const {
    constexpr double kStep = 1e-6;
    std::vector<System::Vector> step(spline.knots.size(), System::Vector::Zero());
    step[knot][row] = kStep;
    Spline up = spline;
    Spline down = spline;
    SplineProblem::apply(step, 1.0, up);
    SplineProblem::apply(step, -1.0, down);
    return (problem.evaluate(up, nullptr) - problem.evaluate(down, nullptr)) / (2.0 * kStep);
  }

  map::DistanceField field = islandField();
  feasibility::Obstacles obstacles{field};
  Originals originals = Originals(4, [] {
    std::array<Eigen::Vector2d, trajectory::kLobattoPoints> points;
    points.fill(Eigen::Vector2d(0.5, 1.0));
    return points;
  }());
  SplineProblem problem;
};

TEST_F(SplineProblemTest, GradientIsThatOfTheCost) {
  problem.targets.limits.room_m = 4.0;
  problem.targets.limits.hull_room_m = 2.5;
  Random random(7);
  const Spline spline = bentSpline(random);
  System system;
  problem.evaluate(spline, &system);
  for (std::size_t k = 0; k < spline.knots.size(); ++k) {
    for (int row = 0; row < kBlockSize; ++row) {
      const bool is_free = row < 8 ? spline.knots[k].free : k < spline.spans.size();
      const double slope = slopeOfTheCost(spline, k, row);
      const double expected = is_free ? -slope : 0.0;
      EXPECT_NEAR(system.right[k][row], expected, 1e-4 * (1.0 + std::abs(slope)))
          << "knot " << k << " row " << row;
    }
  }
}

TEST_F(SplineProblemTest, GradientOfALeaningHullIsThatOfTheCost) {
  vessel::Disturbance felt;
  felt.force_n = {3.0, -4.0};
  const vessel::InverseDynamics leaning(vessel::Parameters(), felt);
  Random random(7);
  const Spline spline = bentSpline(random);
  problem.targets.limits.leaning_clearance_m = 1.8;
  const double upright = problem.evaluate(spline, nullptr);
  problem.targets.leaning = &leaning;
  System system;
  EXPECT_GT(problem.evaluate(spline, &system), upright + 1.0);
  for (std::size_t k = 1; k + 1 < spline.knots.size(); ++k) {
    for (int row = 0; row < kBlockSize; ++row) {
      const double slope = slopeOfTheCost(spline, k, row);
      EXPECT_NEAR(system.right[k][row], -slope, 1e-4 * (1.0 + std::abs(slope)))
          << "knot " << k << " row " << row;
    }
  }
}

TEST_F(SplineProblemTest, GradientOfAnEndThatMovesWithItsManoeuvreIsThatOfTheCost) {
  Random random(13);
  Spline spline = bentSpline(random);
  for (Knot* knot : {&spline.knots.front(), &spline.knots.back()}) {
    EndFamily family;
    for (int row = 0; row < 8; ++row) {
      family.state.row(row) << random.normal(), random.normal();
    }
    family.duration_s = {0.7, -0.2};
    family.reach = {0.3, 0.8};
    family.moved = {0.1, 0.2};
    knot->family = family;
  }
  System system;
  problem.evaluate(spline, &system);
  for (const std::size_t k : {std::size_t{0}, spline.knots.size() - 1}) {
    for (int row = 0; row < 8; ++row) {
      const double slope = slopeOfTheCost(spline, k, row);
      EXPECT_NEAR(system.right[k][row], -slope, 1e-4 * (1.0 + std::abs(slope)))
          << "knot " << k << " parameter " << row;
      EXPECT_EQ(std::abs(slope) > 0.0, row < 2);
    }
  }
}

// A wall to starboard of the spline that comes nearer with time.
struct ComingWall : feasibility::ObstacleLayer {
  [[nodiscard]] double clearance(const Eigen::Vector2d& position, double time_s) const override {
    return position.y() - 0.4 * time_s + 1.0;
  }
  [[nodiscard]] double rateBound() const override { return 0.4; }
  [[nodiscard]] map::DistanceField::Smooth smooth(const Eigen::Vector2d& position,
                                                  double time_s) const override {
    return {clearance(position, time_s), Eigen::Vector2d::UnitY()};
  }
};

TEST_F(SplineProblemTest, ObstaclesCountWhereTheyAreWhenTheSplineIsThere) {
  Random random(7);
  const Spline spline = bentSpline(random);
  const ComingWall wall;
  obstacles.add(wall);
  const auto rise = [&] {
    problem.targets.start_s = 0.0;
    const double at_first = problem.evaluate(spline, nullptr);
    problem.targets.start_s = 5.0;
    return problem.evaluate(spline, nullptr) - at_first;
  };
  SplineLimits& limits = problem.targets.limits;
  limits.hull_offset_m = 0.0;
  EXPECT_GT(rise(), 1.0) << "the hull's centre";
  limits.hull_offset_m = 0.667;
  limits.clearance_m = -100.0;
  EXPECT_GT(rise(), 1.0) << "its ends";
}

// A vessel that shoots across at right angles is on the path for a moment only.
TEST_F(SplineProblemTest, SeesWhatCrossesBetweenTheUsualPoints) {
  constexpr double kFastMps = 40.0;
  constexpr int kTimes = 40;
  Random random(7);
  const Spline spline = bentSpline(random);
  problem.targets.limits.clearance_m = 0.8;
  problem.targets.limits.hull_offset_m = 0.0;
  const feasibility::Obstacles still = obstacles;
  const double alone = problem.evaluate(spline, nullptr);
  int seen_at_usual = 0;
  int seen = 0;
  for (int k = 0; k < kTimes; ++k) {
    // Over the first piece's middle, about when it is sailed.
    const Eigen::Vector2d there =
        0.5 * (spline.knots[0].state.col(0) + spline.knots[1].state.col(0));
    const double when_s = 0.5 * spline.spans[0].duration_s + 0.01 * (k - kTimes / 2);
    const Eigen::Vector2d speed(0.0, kFastMps);
    const feasibility::test::MovingDisc shot(there - when_s * speed, speed, 0.2);
    obstacles = still;
    obstacles.add(shot);
    problem.targets.still = nullptr;
    seen_at_usual += problem.evaluate(spline, nullptr) > alone + 1e-9 ? 1 : 0;
    problem.targets.still = &still;
    seen += problem.evaluate(spline, nullptr) > alone + 1e-9 ? 1 : 0;
  }
  EXPECT_GT(seen_at_usual, 0);
  EXPECT_GT(seen, 1.5 * seen_at_usual);
}

// Counts who asks.
struct AskedWall : ComingWall {
  mutable int asked = 0;
  [[nodiscard]] map::DistanceField::Smooth smooth(const Eigen::Vector2d& position,
                                                  double time_s) const override {
    ++asked;
    return ComingWall::smooth(position, time_s);
  }
};

TEST_F(SplineProblemTest, AsksWhatMovesOnlyWhereItMayBeMet) {
  Random random(7);
  const Spline spline = bentSpline(random);
  const feasibility::Obstacles still = obstacles;
  const AskedWall wall;
  obstacles.add(wall);
  problem.targets.still = &still;
  problem.targets.start_s = 0.0;
  EXPECT_GT(problem.evaluate(spline, nullptr), 0.0);
  const int asked = wall.asked;
  EXPECT_GT(asked, 0);
  // A hundred metres off by then: no piece meets it.
  problem.targets.start_s = -250.0;
  EXPECT_GT(problem.evaluate(spline, nullptr), 0.0);
  EXPECT_EQ(wall.asked, asked);
}

// A first guess leads round what will be there, not round what is there now.
TEST(InitialSpline, MeetsWhatMovesWhereItWillBe) {
  constexpr double kSpeedMps = 2.0;
  const map::DistanceField field(
      [] {
        map::OccupancyGrid grid;
        grid.geometry = {160, 160, 0.5, {-40.0, -40.0}};
        grid.cells.assign(160UL * 160UL, map::Cell::kFree);
        return grid;
      }(),
      {});
  InitialSpline initial{vessel::Parameters()};
  initial.options.speed_max_mps = kSpeedMps;
  initial.options.clearance_m = 2.0;
  SplineEnds ends;
  ends.start.position = {-20.0, 0.0};
  ends.goal.position = {20.0, 0.0};
  ends.start.velocity = ends.goal.velocity = {kSpeedMps, 0.0};
  // How far aside a disc leads that is on the way's middle at a time.
  const auto asideOf = [&](double when_s) {
    const Eigen::Vector2d speed(0.0, 1.0);
    const feasibility::test::MovingDisc disc(Eigen::Vector2d(0.0, 0.5) - when_s * speed, speed,
                                             1.0);
    feasibility::Obstacles obstacles(field);
    obstacles.add(disc);
    Spline spline;
    initial.build(obstacles, {ends.start.position, ends.goal.position}, ends, spline);
    double most = 0.0;
    for (const Knot& knot : spline.knots) {
      most = std::max(most, std::abs(knot.state(1, 0)));
    }
    return most;
  };
  EXPECT_LT(asideOf(0.0), 0.05) << "it has gone by then";
  EXPECT_GT(asideOf(20.0 / kSpeedMps), 0.5) << "it comes";
}

TEST_F(SplineProblemTest, ClosedFormStepIsTheDenseSolution) {
  Random random(11);
  const Spline spline = bentSpline(random);
  System system;
  problem.evaluate(spline, &system);
  ASSERT_TRUE(system.solve(1e-3, 1e-9));

  const auto n = static_cast<Eigen::Index>(kBlockSize * spline.knots.size());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right(n);
  for (std::size_t k = 0; k < spline.knots.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(kBlockSize * k);
    System::Block diagonal = system.diagonal[k].selfadjointView<Eigen::Lower>();
    diagonal.diagonal() += (1e-3 * system.diagonal[k].diagonal()).array().max(1e-9).matrix();
    dense.block<kBlockSize, kBlockSize>(at, at) = diagonal;
    if (k + 1 < spline.knots.size()) {
      dense.block<kBlockSize, kBlockSize>(at + kBlockSize, at) = system.below[k];
      dense.block<kBlockSize, kBlockSize>(at, at + kBlockSize) = system.below[k].transpose();
    }
    right.segment<kBlockSize>(at) = system.right[k];
  }
  const Eigen::VectorXd expected = dense.ldlt().solve(right);
  for (std::size_t k = 0; k < spline.knots.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(kBlockSize * k);
    EXPECT_LT((system.solution()[k] - expected.segment<kBlockSize>(at)).norm(),
              1e-8 * (1.0 + expected.norm()));
  }
}

}  // namespace
}  // namespace otter_nav::optimizer
