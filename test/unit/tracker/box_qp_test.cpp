// The quadratic problem's strategies, each alone, on random problems: against a dense reference and
// against each other.
#include "tracker/qp/box_qp.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include "tracker/qp/active_set.hpp"
#include "tracker/qp/interior_point.hpp"
#include "tracker/qp/projected_newton.hpp"

namespace otter_nav::tracker::qp {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// Stages like a boat's: stable, coupled, with some bounds met. `width_n` is that of the bounds.
std::unique_ptr<BoxQp> randomProblem(unsigned seed, int stages, double width_n) {
  std::mt19937 random(seed);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  auto qp = std::make_unique<BoxQp>(stages);
  for (int k = 0; k < stages; ++k) {
    Stage& s = qp->linear[k];
    for (int row = 0; row < 6; ++row) {
      for (int i = 0; i < 4; ++i) {
        s.a[row][i] = draw(-0.1, 0.1) + (row == i + 2 ? 0.9 : 0.0);
      }
      s.bc[row] = Pack{draw(-0.01, 0.01), draw(-0.01, 0.01), draw(-0.1, 0.1), 0.0};
    }
    for (int i = 0; i < 2; ++i) {
      qp->input_costs[k].weight[i] = draw(1e-4, 1e-2);
      qp->input_costs[k].gradient[i] = draw(-0.1, 0.1);
      qp->lower[k][i] = draw(-width_n, 0.2 * width_n);
      qp->upper[k][i] = qp->lower[k][i] + draw(0.2, 1.0) * width_n;
    }
  }
  for (int k = 0; k <= stages; ++k) {
    StateCost& cost = qp->state_costs[k];
    for (int i = 0; i < 4; ++i) {
      cost.weight_q[i] = draw(0.0, 10.0);
      cost.gradient_q[i] = draw(-10.0, 10.0);
    }
    for (int i = 0; i < 2; ++i) {
      cost.weight_p[i] = draw(1.0, 20.0);
      cost.gradient_p[i] = draw(-10.0, 10.0);
    }
  }
  for (double& d : qp->dx[0]) {
    d = draw(-1.0, 1.0);
  }
  return qp;
}

// The same problem in the thrusts alone: 1/2 u'Hu + g'u within the bounds.
struct Dense {
  Matrix hessian;
  Vector gradient, lower, upper;
};

Dense condense(const BoxQp& qp) {
  const int n = 2 * qp.stages();
  Dense d{Matrix::Zero(n, n), Vector::Zero(n), Vector(n), Vector(n)};
  Vector x = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(qp.dx[0]);
  Matrix by_u = Matrix::Zero(6, n);
  const auto addCost = [&](int k) {
    const StateCost& c = qp.state_costs[k];
    Vector w(6);
    Vector q(6);
    w << c.weight_p[0], c.weight_p[1], c.weight_q[0], c.weight_q[1], c.weight_q[2], c.weight_q[3];
    q << c.gradient_p[0], c.gradient_p[1], c.gradient_q[0], c.gradient_q[1], c.gradient_q[2],
        c.gradient_q[3];
    d.hessian += by_u.transpose() * w.asDiagonal() * by_u;
    d.gradient += by_u.transpose() * (w.cwiseProduct(x) + q);
  };
  for (int k = 0; k < qp.stages(); ++k) {
    addCost(k);
    Matrix a = Matrix::Zero(6, 6);
    Matrix b(6, 2);
    Vector c(6);
    a.topLeftCorner<2, 2>().setIdentity();
    for (int row = 0; row < 6; ++row) {
      for (int i = 0; i < 4; ++i) {
        a(row, i + 2) = qp.linear[k].a[row][i];
      }
      b.row(row) << qp.linear[k].bc[row][0], qp.linear[k].bc[row][1];
      c[row] = qp.linear[k].bc[row][2];
    }
    x = a * x + c;
    by_u = (a * by_u).eval();
    by_u.middleCols<2>(2 * k) += b;
    for (int i = 0; i < 2; ++i) {
      d.hessian(2 * k + i, 2 * k + i) += qp.input_costs[k].weight[i];
      d.gradient[2 * k + i] += qp.input_costs[k].gradient[i];
      d.lower[2 * k + i] = qp.lower[k][i];
      d.upper[2 * k + i] = qp.upper[k][i];
    }
  }
  addCost(qp.stages());
  return d;
}

// Coordinate descent: slow, plain, and right for any convex box problem.
Vector solveDense(const Dense& d) {
  Vector u = Vector::Zero(d.gradient.size()).cwiseMax(d.lower).cwiseMin(d.upper);
  for (int sweep = 0; sweep < 200000; ++sweep) {
    double moved = 0.0;
    for (int i = 0; i < u.size(); ++i) {
      const double slope = d.hessian.row(i).dot(u) + d.gradient[i];
      const double next = std::clamp(u[i] - slope / d.hessian(i, i), d.lower[i], d.upper[i]);
      moved = std::max(moved, std::abs(next - u[i]));
      u[i] = next;
    }
    if (moved < 1e-13) {
      break;
    }
  }
  return u;
}

// How far the projected gradient is from zero, relative to the gradient at u = 0.
double residual(const Dense& d, const Vector& u) {
  const Vector slope = d.hessian * u + d.gradient;
  const Vector scale = d.hessian.diagonal();
  const Vector step = (u - slope.cwiseQuotient(scale)).cwiseMax(d.lower).cwiseMin(d.upper) - u;
  return step.cwiseAbs().maxCoeff();
}

Vector inputsOf(const BoxQp& qp) {
  return Eigen::Map<const Vector>(&qp.du[0][0], 2 * qp.stages());
}

using Solve = std::function<Outcome(BoxQp&)>;
struct Strategy {
  const char* name;
  Solve solve;
};

std::vector<Strategy> strategies(int iterations) {
  return {{"active set", [=](BoxQp& qp) { return ActiveSet(iterations).solve(qp); }},
          {"projected Newton", [=](BoxQp& qp) { return ProjectedNewton(iterations).solve(qp); }},
          {"interior point", [=](BoxQp& qp) {
             qp.rollOut();
             return InteriorPoint(iterations).solve(qp);
           }}};
}

class BoxQpTest : public ::testing::TestWithParam<double> {};

TEST_P(BoxQpTest, StrategiesAgreeWithTheDenseSolutionAndEachOther) {
  int solved[3] = {0, 0, 0};
  for (unsigned seed = 0; seed < 24; ++seed) {
    const auto qp = randomProblem(seed, 3 + static_cast<int>(seed % 20), GetParam());
    const Dense dense = condense(*qp);
    const Vector right = solveDense(dense);
    ASSERT_LT(residual(dense, right), 1e-10) << seed;
    int which = 0;
    for (const Strategy& strategy : strategies(60)) {
      qp->freeAll();
      ASSERT_TRUE(qp->factor());
      const Outcome outcome = strategy.solve(*qp);
      if (outcome.status == SolverStatus::kSolved) {
        ++solved[which];
        EXPECT_LT((inputsOf(*qp) - right).cwiseAbs().maxCoeff(), 1e-6 * GetParam())
            << strategy.name << ", seed " << seed;
      } else {
        EXPECT_EQ(which, 0) << strategy.name << ", seed " << seed;  // active sets may cycle
      }
      ++which;
    }
  }
  EXPECT_GT(solved[0], 18);
  EXPECT_EQ(solved[1], 24);
  EXPECT_EQ(solved[2], 24);
}

INSTANTIATE_TEST_SUITE_P(Widths, BoxQpTest, ::testing::Values(1.0, 20.0, 1e4));

// With room enough the feedback of the first recursion is the answer of all.
TEST(BoxQp, WithoutBoundsMetNeedsNoIteration) {
  const auto qp = randomProblem(7, 12, 1.0);
  std::fill(&qp->lower[0][0], &qp->lower[0][0] + 24, -1e6);
  std::fill(&qp->upper[0][0], &qp->upper[0][0] + 24, 1e6);
  ASSERT_TRUE(qp->factor());
  EXPECT_EQ(ActiveSet(0).solve(*qp).status, SolverStatus::kSolved);
  const Dense dense = condense(*qp);
  const Vector right = dense.hessian.llt().solve(-dense.gradient);
  EXPECT_LT((inputsOf(*qp) - right).cwiseAbs().maxCoeff(), 1e-8 * right.norm());
}

// dx follows du, and both roll-outs see the same cost.
TEST(BoxQp, RollOutsAgree) {
  const auto qp = randomProblem(3, 10, 20.0);
  ASSERT_TRUE(qp->factor());
  bool clipped = false;
  const double cost = qp->rollOutClipped(clipped);
  EXPECT_TRUE(clipped);
  EXPECT_DOUBLE_EQ(qp->rollOutInputs(), cost);
  const Dense dense = condense(*qp);
  const auto denseCost = [&](const Vector& u) {
    return 0.5 * u.dot(dense.hessian * u) + dense.gradient.dot(u);
  };
  const Vector u = inputsOf(*qp);
  std::fill(&qp->du[0][0], &qp->du[0][0] + 20, 0.0);
  EXPECT_NEAR(cost - qp->rollOutInputs(), denseCost(u), 1e-8 * std::abs(cost));
}

// What is cut short says so and keeps to the bounds, apart from the active set, whose caller goes
// on with another.
TEST(BoxQp, StrategiesSayWhenIterationsRunOut) {
  const auto qp = randomProblem(5, 20, 20.0);
  for (const Strategy& strategy : strategies(1)) {
    qp->freeAll();
    ASSERT_TRUE(qp->factor());
    const Outcome outcome = strategy.solve(*qp);
    EXPECT_EQ(outcome.status, SolverStatus::kIterationsExhausted) << strategy.name;
    EXPECT_EQ(outcome.iterations, 1) << strategy.name;
    if (std::string(strategy.name) != "active set") {
      for (int k = 0; k < 20; ++k) {
        for (int i = 0; i < 2; ++i) {
          EXPECT_GE(qp->du[k][i], qp->lower[k][i]) << strategy.name;
          EXPECT_LE(qp->du[k][i], qp->upper[k][i]) << strategy.name;
        }
      }
    }
  }
}

TEST(BoxQp, RefusesWhatHasNoMinimum) {
  const auto qp = randomProblem(5, 8, 20.0);
  qp->input_costs[4].weight[0] = -1e3;
  EXPECT_FALSE(qp->factor());
}

}  // namespace
}  // namespace otter_nav::tracker::qp
