#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "otter_nav/base/random.hpp"
#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/trajectory/polynomial/block_tridiagonal.hpp"
#include "otter_nav/trajectory/polynomial/hermite.hpp"
#include "otter_nav/trajectory/polynomial/path_line.hpp"
#include "otter_nav/trajectory/polynomial/quadrature.hpp"
#include "otter_nav/trajectory/polynomial/real_roots.hpp"

namespace otter_nav::trajectory {
namespace {

TEST(RealRoots, FindsTheRootsOfAProduct) {
  // (x - 1)(x - 2)(x - 3)(x + 4)(x^2 + 1)
  const Polynomial p = {-24.0, 38.0, -37.0, 36.0, -12.0, -2.0, 1.0};
  const Roots roots = realRoots(p, -10.0, 10.0);
  ASSERT_EQ(roots.count, 4);
  const std::array<double, 4> expected = {-4.0, 1.0, 2.0, 3.0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(roots.value[i], expected[i], 1e-9);
  }
  EXPECT_GE(rootBound(p), 4.0);
}

TEST(RealRoots, StaysWithinTheInterval) {
  const Polynomial p = {-6.0, 11.0, -6.0, 1.0};  // 1, 2, 3
  const Roots roots = realRoots(p, 1.5, 2.5);
  ASSERT_EQ(roots.count, 1);
  EXPECT_NEAR(roots.value[0], 2.0, 1e-12);
}

TEST(RealRoots, OfAConstantAreNone) {
  EXPECT_EQ(realRoots({5.0}, -1.0, 1.0).count, 0);
  EXPECT_EQ(rootBound({5.0}), 0.0);
}

// Uniform in [-1, 1].
template <typename Matrix>
Matrix randomMatrix(Random& random) {
  return Matrix::NullaryExpr([&](Eigen::Index, Eigen::Index) { return random.uniform(-1.0, 1.0); });
}

TEST(Hermite, BasesGiveThePiecesTheyBelongTo) {
  Random random(5);
  constexpr double kT = 1.7;
  const auto from = randomMatrix<Eigen::Matrix<double, 2, 4>>(random);
  const auto to = randomMatrix<Eigen::Matrix<double, 2, 4>>(random);
  const auto point = [](const Eigen::Matrix<double, 2, 4>& c) {
    return vessel::FlatPoint{c.col(0), c.col(1), c.col(2), c.col(3), Eigen::Vector2d::Zero()};
  };
  const Piece septic = hermitePiece(point(from), point(to), kT);
  const Piece quintic = quinticPiece(from.leftCols<3>(), to.leftCols<3>(), kT);
  Eigen::Matrix<double, 2, 6> unit;
  unit << from.leftCols<3>(), to.leftCols<3>();
  for (const int k : {1, 2, 4, 5}) {
    unit.col(k) *= std::pow(kT, k % 3);
  }
  Eigen::Matrix<double, 2, 8> ends;
  ends << from, to;
  for (const double s : {0.0, 0.3, 1.0}) {
    const vessel::FlatPoint a = septic.flat(s * kT);
    const SepticBasis basis = scaleBasis(septicBasis(s), kT);
    EXPECT_LT((ends * basis.row(0).transpose() - a.position).norm(), 1e-12);
    EXPECT_LT((ends * basis.row(4).transpose() - a.snap).norm(), 1e-9);
    const SepticBasis longer = scaleBasis(septicBasis(s), kT + 1e-6);
    EXPECT_LT((longer - basis - 1e-6 * byDuration(basis, kT)).norm(), 1e-8);
    const vessel::FlatPoint b = quintic.flat(s * kT);
    EXPECT_LT((unit * quinticBasis(s).row(0).transpose() - b.position).norm(), 1e-12);
    EXPECT_LT((unit * quinticBasis(s).row(2).transpose() / (kT * kT) - b.acceleration).norm(),
              1e-11);
  }
  const double jerk = (unit * quinticJerk() * unit.transpose()).trace() / std::pow(kT, 5);
  EXPECT_NEAR(jerk, squaredJerk(quintic), 1e-9 * jerk);
}

TEST(Quadrature, IsExactToItsDegree) {
  double gauss = 0.0;
  double lobatto = 0.0;
  for (std::size_t i = 0; i < kGauss.at.size(); ++i) {
    gauss += kGauss.weight[i] * std::pow(kGauss.at[i], 8);
  }
  for (std::size_t i = 0; i < kLobatto.at.size(); ++i) {
    lobatto += kLobatto.weight[i] * std::pow(kLobatto.at[i], 13);
  }
  EXPECT_NEAR(gauss, 2.0 / 9.0, 1e-15);
  EXPECT_NEAR(lobatto, 1.0 / 14.0, 1e-15);
}

TEST(BlockTridiagonal, SolvesAsADenseSystemDoes) {
  Random random(8);
  constexpr int kBlocks = 4;
  BlockTridiagonal<3, 2, 6> system;
  system.reset(kBlocks);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * kBlocks, 3 * kBlocks);
  Eigen::MatrixXd right(3 * kBlocks, 2);
  for (int k = 0; k < kBlocks; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto a = randomMatrix<Eigen::Matrix3d>(random);
    system.diagonal[i] = a * a.transpose() + 6.0 * Eigen::Matrix3d::Identity();
    system.below[i] = randomMatrix<Eigen::Matrix3d>(random);
    system.right[i] = randomMatrix<Eigen::Matrix<double, 3, 2>>(random);
    dense.block<3, 3>(3 * k, 3 * k) = system.diagonal[i];
    if (k + 1 < kBlocks) {
      dense.block<3, 3>(3 * k + 3, 3 * k) = system.below[i];
      dense.block<3, 3>(3 * k, 3 * k + 3) = system.below[i].transpose();
    }
    right.middleRows<3>(3 * k) = system.right[i];
  }
  ASSERT_TRUE(system.solve(0.0, 0.0));
  const Eigen::MatrixXd expected = dense.ldlt().solve(right);
  for (int k = 0; k < kBlocks; ++k) {
    EXPECT_LT(
        (system.solution()[static_cast<std::size_t>(k)] - expected.middleRows<3>(3 * k)).norm(),
        1e-12);
  }
}

struct Distance {
  double distance_m;
  Eigen::Vector2d gradient;
};

TEST(PathLine, RoundsCornersAndKeepsOffObstacles) {
  const Eigen::Vector2d rock(10.0, 0.3);
  PathLine line;
  line.resample({{0.0, 0.0}, {20.0, 0.0}, {20.0, 10.0}}, 1.0, 2);
  EXPECT_NEAR(line.length(), 30.0, 1e-12);
  line.relax(
      [&](const Eigen::Vector2d& p) {
        return Distance{(p - rock).norm(), (p - rock).normalized()};
      },
      2.0, 40, 2, 0);
  EXPECT_LT(line.length(), 30.0);
  for (const PathLine::Point& point : line.points()) {
    EXPECT_GT((point.position - rock).norm(), 1.7);
  }
  EXPECT_EQ(line.points()[2].position, Eigen::Vector2d(2.0, 0.0));
  EXPECT_EQ(line.points().back().position, Eigen::Vector2d(20.0, 10.0));
}

// What is far off is asked for once, and comes near all the same.
TEST(PathLine, AsksForDistancesWhereSomethingMayHaveComeNear) {
  constexpr int kRounds = 60;
  constexpr double kClearanceM = 2.0;
  const Eigen::Vector2d rock(30.0, -3.4);
  const std::vector<Eigen::Vector2d> corners = {
      {0.0, 0.0}, {30.0, -6.0}, {60.0, 0.0}, {60.0, 40.0}};
  PathLine line;
  line.resample(corners, 1.0, 2);
  std::vector<Eigen::Vector2d> asked_always;
  for (const PathLine::Point& point : line.points()) {
    asked_always.push_back(point.position);
  }
  int asked = 0;
  line.relax(
      [&](const Eigen::Vector2d& p) {
        ++asked;
        return Distance{(p - rock).norm(), (p - rock).normalized()};
      },
      kClearanceM, kRounds);
  const std::size_t count = asked_always.size();
  bool pushed = false;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Eigen::Vector2d> moved = asked_always;
    for (std::size_t i = 1; i + 1 < count; ++i) {
      moved[i] = 0.5 * asked_always[i] + 0.25 * (asked_always[i - 1] + asked_always[i + 1]);
      const Eigen::Vector2d off = moved[i] - rock;
      if (off.norm() < kClearanceM) {
        moved[i] += std::min(kClearanceM - off.norm(), 0.5) * off.normalized();
        pushed = true;
      }
    }
    asked_always = moved;
  }
  ASSERT_TRUE(pushed);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_NEAR((line.points()[i].position - asked_always[i]).norm(), 0.0, 1e-9) << i;
  }
  EXPECT_LT(asked, static_cast<int>(count) * kRounds / 4);
  EXPECT_GT(asked, static_cast<int>(count));
}

TEST(PathLine, SpeedsAreWhatTurnsAndThrustAllow) {
  PathLine line;
  line.resample({{0.0, 0.0}, {20.0, 0.0}, {20.0, 20.0}}, 1.0, 2);
  line.relax([](const Eigen::Vector2d& p) { return Distance{1e3, p}; }, 1.0, 10);
  line.setDirections();
  line.setSpeeds([](double k) { return std::min(4.0, 0.5 / std::max(k, 1e-9)); },
                 [](double) { return 0.5; }, [](double) { return 1.0; }, 1.0, 0.0);
  const auto& points = line.points();
  EXPECT_EQ(points.front().speed_mps, 1.0);
  EXPECT_EQ(points.back().speed_mps, 0.0);
  double slowest = 4.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double gained =
        0.5 * (std::pow(points[i].speed_mps, 2) - std::pow(points[i - 1].speed_mps, 2)) /
        line.spacing();
    EXPECT_LT(gained, 0.5 + 1e-9);
    EXPECT_GT(gained, -1.0 - 1e-9);
    EXPECT_LE(points[i].speed_mps * points[i].curvature_per_m, 0.5 + 1e-9);
    slowest = i > 10 && i < 30 ? std::min(slowest, points[i].speed_mps) : slowest;
  }
  EXPECT_LT(slowest, 3.5);
}

}  // namespace
}  // namespace otter_nav::trajectory
