#include "uncertainty.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace otter_nav::identification {
namespace {

// A window's information on the shared variables with its initial state eliminated (Schur
// complement), and its gradient likewise.
struct Reduced {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
};

Reduced reduce(const WindowTerms& t, int shared) {
  Reduced r{t.gradient.head(shared), t.hessian.topLeftCorner(shared, shared)};
  const Eigen::Index local = t.gradient.size() - shared;
  if (local > 0) {
    const Eigen::MatrixXd border = t.hessian.bottomLeftCorner(local, shared);
    const Eigen::LDLT<Eigen::MatrixXd> own(t.hessian.bottomRightCorner(local, local));
    r.gradient -= border.transpose() * own.solve(t.gradient.tail(local));
    r.hessian -= border.transpose() * own.solve(border);
  }
  return r;
}

struct Information {
  Eigen::MatrixXd hessian;  // sum over windows
  Eigen::MatrixXd spread;   // sum of gradient gradient^T
};

Information informationAt(const Problem& problem, const Eigen::VectorXd& variables) {
  const int n = problem.sharedCount();
  Information sum{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  WindowTerms terms;
  for (std::size_t w = 0; w < problem.windowCount(); ++w) {
    problem.evaluateWindow(w, variables, &terms);
    const Reduced r = reduce(terms, n);
    sum.hessian += r.hessian;
    sum.spread += r.gradient * r.gradient.transpose();
  }
  return sum;
}

bool isAtBound(const Parameter& p, double value) {
  const double near = 1e-4 * p.scale;
  return value < p.lower + near || value > p.upper - near;
}

// Scales of the parameters at their values, so that deviations are relative.
Eigen::VectorXd magnitudes(const Problem& problem, const Eigen::VectorXd& variables) {
  Eigen::VectorXd d(problem.sharedCount());
  for (int i = 0; i < d.size(); ++i) {
    const double scale = problem.shared()[static_cast<std::size_t>(i)].scale;
    d[i] = std::max(std::abs(variables[i]), 0.1 * scale);
  }
  return d;
}

}  // namespace

Uncertainty uncertainty(const Problem& problem, const Eigen::VectorXd& variables) {
  const int n = problem.sharedCount();
  const Information information = informationAt(problem, variables);
  const Eigen::VectorXd d = magnitudes(problem, variables);
  Eigen::MatrixXd h = d.asDiagonal() * information.hessian * d.asDiagonal();
  h.diagonal() += d.cwiseAbs2().cwiseProduct(problem.priorHessian());
  Eigen::MatrixXd g = d.asDiagonal() * information.spread * d.asDiagonal();
  Uncertainty result;
  result.at_bound.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const bool held = isAtBound(problem.shared()[static_cast<std::size_t>(i)], variables[i]);
    result.at_bound[static_cast<std::size_t>(i)] = held;
    if (held) {
      h.row(i).setZero();
      h.col(i).setZero();
      h(i, i) = 1.0;
      g.row(i).setZero();
      g.col(i).setZero();
    }
  }
  const Eigen::LDLT<Eigen::MatrixXd> factor(h);
  const Eigen::MatrixXd half = factor.solve(g);
  const Eigen::MatrixXd covariance = factor.solve(half.transpose());
  // Few windows underestimate the spread as a sample of few values does.
  const double windows = static_cast<double>(problem.windowCount());
  const double small_sample = windows / std::max(1.0, windows - n);
  result.standard_error =
      (small_sample * covariance.diagonal().cwiseMax(0.0)).cwiseSqrt().cwiseProduct(d);
  return result;
}

Status checkIdentifiable(const Problem& problem, const Eigen::VectorXd& variables, double limit) {
  const Eigen::VectorXd d = magnitudes(problem, variables);
  const Eigen::MatrixXd h =
      d.asDiagonal() * informationAt(problem, variables).hessian * d.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(h);
  // Directions without any information get a variance that is surely over the limit.
  const Eigen::VectorXd variance = eigen.eigenvalues().cwiseMax(1e-12).cwiseInverse();
  std::string names;
  for (int i = 0; i < d.size(); ++i) {
    const double relative =
        std::sqrt(eigen.eigenvectors().row(i).cwiseAbs2().dot(variance.transpose()));
    if (relative > limit) {
      names += (names.empty() ? "" : ", ") + problem.shared()[static_cast<std::size_t>(i)].name;
    }
  }
  if (!names.empty()) {
    return failure("the recorded motion does not determine " + names +
                   ": relative standard error above " + std::to_string(limit) +
                   "; record speed changes and turns to both sides");
  }
  return {};
}

}  // namespace otter_nav::identification
