#include "planner/obvp.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "otter_nav/base/random.hpp"

namespace otter_nav::planner {
namespace {

KinoState randomState(Random& random) {
  const auto vector = [&](double scale) {
    const double x = scale * random.uniform(-1.0, 1.0);
    const double y = scale * random.uniform(-1.0, 1.0);
    return Eigen::Vector2d(x, y);
  };
  KinoState state;
  state.position = vector(20.0);
  state.velocity = vector(4.0);
  state.acceleration = vector(1.0);
  return state;
}

TEST(Obvp, PieceMeetsBothStates) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const KinoState from = randomState(random);
    const KinoState to = randomState(random);
    const trajectory::Piece piece = quinticPiece(from, to, random.uniform(1.0, 15.0));
    const vessel::FlatPoint start = piece.flat(0.0);
    const vessel::FlatPoint end = piece.flat(piece.duration_s);
    EXPECT_LT((start.position - from.position).norm(), 1e-9);
    EXPECT_LT((start.velocity - from.velocity).norm(), 1e-9);
    EXPECT_LT((start.acceleration - from.acceleration).norm(), 1e-9);
    EXPECT_LT((end.position - to.position).norm(), 1e-8);
    EXPECT_LT((end.velocity - to.velocity).norm(), 1e-8);
    EXPECT_LT((end.acceleration - to.acceleration).norm(), 1e-8);
  }
}

TEST(Obvp, CostFormulaIsTheIntegralOfThePiece) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const KinoState from = randomState(random);
    const KinoState to = randomState(random);
    const double duration = random.uniform(1.0, 15.0);
    const double formula = SteerCost(from, to, 1.0).at(duration);
    const double integral = pieceCost(quinticPiece(from, to, duration), 1.0);
    EXPECT_NEAR(formula, integral, 1e-9 * formula);
  }
}

// The oracle: J on a fine grid of durations, refined around its least value.
double numericMinimum(const SteerCost& cost) {
  double best = 0.02;
  for (double t = 0.02; t < 60.0; t += 0.01) {
    if (cost.at(t) < cost.at(best)) {
      best = t;
    }
  }
  double low = best - 0.01;
  double high = best + 0.01;
  for (int i = 0; i < 100; ++i) {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    (cost.at(a) < cost.at(b) ? high : low) = cost.at(a) < cost.at(b) ? b : a;
  }
  return cost.at(0.5 * (low + high));
}

TEST(Obvp, DurationIsTheBestOfAllDurations) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const KinoState from = randomState(random);
    const KinoState to = randomState(random);
    const double sigma = i % 2 == 0 ? 1.0 : 10.0;
    const auto found = steer(from, to, sigma);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->cost, numericMinimum(SteerCost(from, to, sigma)), 1e-7 * found->cost);
  }
}

TEST(Obvp, RestToRestHasTheKnownDuration) {
  KinoState from;
  KinoState to;
  to.position = {30.0, 40.0};
  const auto found = steer(from, to, 1.0);
  ASSERT_TRUE(found);
  // J = T + 720 D^2 / T^5.
  EXPECT_NEAR(found->duration_s, std::pow(3600.0 * 2500.0, 1.0 / 6.0), 1e-9);
}

TEST(Obvp, NoTransferBetweenAStateAtRestAndItself) {
  EXPECT_FALSE(steer(KinoState{}, KinoState{}, 1.0));
}

}  // namespace
}  // namespace otter_nav::planner
