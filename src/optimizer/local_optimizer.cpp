#include "otter_nav/optimizer/local_optimizer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "optimizer/objective/cost.hpp"
#include "otter_nav/base/planar.hpp"
#include "otter_nav/trajectory/polynomial/block_tridiagonal.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"

namespace otter_nav::optimizer {
namespace {

constexpr double kStretch = 1.15;  // of the edge's time when its dynamics fail
constexpr double kLeastPushM = 0.1;
constexpr double kPushMaxM = 6.0;  // farther from the edge than this no guidance point is sought
constexpr double kMarginM = 0.2;   // beyond the clearance, that guidance points stand off
constexpr int kSolutions = 4;      // with raised weights
// The paper's weights.
constexpr double kSmooth = 0.02;
constexpr double kClearance = 10.0;
constexpr double kDynamics = 2.0;
constexpr double kOriginal = 0.05;
constexpr double kRaise = 4.0;  // of clearance and dynamics, from solution to solution

// T^k of the end values [p v a p v a].
Eigen::Matrix<double, 6, 1> powers(double T) {
  Eigen::Matrix<double, 6, 1> s;
  s << 1.0, T, T * T, 1.0, T, T * T;
  return s;
}

}  // namespace

LocalOptimizer::LocalOptimizer() : jerk_(trajectory::quinticJerk()) {
  for (int i = 0; i < kPoints; ++i) {
    basis_[static_cast<std::size_t>(i)] = trajectory::quinticBasis((i + 0.5) / kPoints);
  }
}

// Guidance points (f_c): each colliding stretch moves aside as a whole, square to its course, to
// the side where it has less far to go.
void LocalOptimizer::guideStretch(const feasibility::EdgeCheck& check, const States& states,
                                  int first, int last, double weight, Pulls& pulls) const {
  const map::DistanceField& field = check.obstacles().field();
  const double safe = check.clearance() + kMarginM + kSquareCells * field.geometry().resolution_m;
  std::array<Eigen::Vector2d, kSegments * kPoints> best;
  double best_m = kPushMaxM;
  bool found = false;
  for (const double side : {1.0, -1.0}) {
    std::array<Eigen::Vector2d, kSegments * kPoints> guided;
    double farthest = 0.0;
    for (int i = first; i <= last && farthest < best_m; ++i) {
      const auto index = static_cast<std::size_t>(i);
      const Eigen::Vector2d& course = states[index].col(1);
      const Eigen::Vector2d aside = side / std::max(course.norm(), 1e-6) * across(course);
      double moved = 0.0;
      double distance = field.smooth(states[index].col(0)).distance_m;
      while (distance < safe && moved < best_m) {
        moved += std::max(safe - distance, kLeastPushM);
        distance = field.smooth(states[index].col(0) + moved * aside).distance_m;
      }
      guided[index] = states[index].col(0) + moved * aside;
      farthest = std::max(farthest, moved);
    }
    if (farthest < best_m) {
      best_m = farthest;
      best = guided;
      found = true;
    }
  }
  for (int i = first; i <= last && found; ++i) {
    Pull& pull =
        pulls[static_cast<std::size_t>(i / kPoints)][static_cast<std::size_t>(i % kPoints)];
    pull.target.col(0) = best[static_cast<std::size_t>(i)];
    pull.weight[0] = weight;
  }
}

// Each point is drawn to where it was (f_o); a colliding one instead to its guidance point (f_c);
// one beyond a limit to the limit (f_d).
void LocalOptimizer::pullTowards(const feasibility::EdgeCheck& check, const Knots& knots,
                                 double step_s, double growth, Pulls& pulls) const {
  const map::DistanceField& field = check.obstacles().field();
  const double need =
      check.clearance() + 0.5 * kMarginM + kSquareCells * field.geometry().resolution_m;
  const double force = check.forceMax();
  const vessel::InverseDynamics& inverse = check.inverse();
  const Eigen::Matrix<double, 6, 1> scale = powers(step_s);
  States states;
  int stretch = -1;  // first point of the colliding stretch
  const int count = kSegments * kPoints;
  for (int i = 0; i < count; ++i) {
    const auto segment = static_cast<std::size_t>(i / kPoints);
    const auto point = static_cast<std::size_t>(i % kPoints);
    Eigen::Matrix<double, 2, 6> ends;
    ends << knots[segment], knots[segment + 1];
    Eigen::Matrix<double, 2, 3>& z = states[static_cast<std::size_t>(i)];
    z = ends * scale.asDiagonal() * basis_[point].transpose();
    z.col(1) /= step_s;
    z.col(2) /= step_s * step_s;
    Pull& pull = pulls[segment][point];
    pull.weight[0] = std::max(pull.weight[0], kOriginal);
    const bool collides = field.smooth(z.col(0)).distance_m < need;
    if (collides && stretch < 0) {
      stretch = i;
    }
    if (stretch >= 0 && (!collides || i + 1 == count)) {
      guideStretch(check, states, stretch, collides ? i : i - 1, kClearance * growth, pulls);
      stretch = -1;
    }
    const double speed = z.col(1).norm();
    if (speed > check.speedMaxEver()) {
      pull.target.col(1) = 0.95 * check.speedMaxEver() / speed * z.col(1);
      pull.weight[1] = kDynamics * growth;
    }
    const double asked = inverse.push(inverse.throughWater(z.col(1)), z.col(1), z.col(2)).norm();
    if (asked > force) {
      pull.target.col(2) = z.col(2) * (force / asked);
      pull.weight[2] = kDynamics * growth;
    }
  }
}

// The minimum of F in the inner knots: x and y share the matrix, 3 by 3 blocks on three diagonals.
void LocalOptimizer::solve(const Pulls& pulls, double step_s, Knots& knots) const {
  const auto n = std::size_t{kSegments};
  trajectory::BlockTridiagonal<3, 2, kKnots> system;  // block k is of knot k + 1
  system.reset(n - 1);
  const Eigen::Matrix<double, 6, 1> scale = powers(step_s);
  const Eigen::Vector3d rate(1.0, 1.0 / step_s, 1.0 / (step_s * step_s));
  const Eigen::Matrix<double, 6, 6> smooth =
      kSmooth / std::pow(step_s, 5) * scale.asDiagonal() * jerk_ * scale.asDiagonal();
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Matrix<double, 6, 6> hessian = smooth;
    Eigen::Matrix<double, 6, 2> linear = Eigen::Matrix<double, 6, 2>::Zero();
    for (std::size_t k = 0; k < kPoints; ++k) {
      const Eigen::Matrix<double, 3, 6> rows = rate.asDiagonal() * basis_[k] * scale.asDiagonal();
      const Eigen::Vector3d weight = step_s / kPoints * pulls[i][k].weight;
      hessian += rows.transpose() * weight.asDiagonal() * rows;
      linear += rows.transpose() * weight.asDiagonal() * pulls[i][k].target.transpose();
    }
    const Eigen::Matrix3d below = hessian.bottomLeftCorner<3, 3>();
    const bool first = i == 0;
    const bool last = i + 1 == n;
    if (!first) {
      system.diagonal[i - 1] += hessian.topLeftCorner<3, 3>();
      system.right[i - 1] += linear.topRows<3>();
    }
    if (!last) {
      system.diagonal[i] += hessian.bottomRightCorner<3, 3>();
      system.right[i] += linear.bottomRows<3>();
    }
    // The ends are given.
    if (first) {
      system.right[0] -= below * knots[0].transpose();
    } else if (last) {
      system.right[n - 2] -= below.transpose() * knots[n].transpose();
    } else {
      system.below[i - 1] = below;
    }
  }
  if (!system.solve(0.0, 0.0)) {
    return;
  }
  for (std::size_t k = 1; k < n; ++k) {
    knots[k] = system.solution()[k - 1].transpose();
  }
}

feasibility::EdgeFault LocalOptimizer::join(const feasibility::EdgeCheck& check, const Knots& knots,
                                            double start_s, double step_s,
                                            RepairedEdge& repaired) const {
  repaired.duration_s = step_s * kSegments;
  for (std::size_t i = 0; i < std::size_t{kSegments}; ++i) {
    repaired.pieces[i] = trajectory::quinticPiece(knots[i], knots[i + 1], step_s);
    const feasibility::EdgeFault fault =
        check.checkBent(repaired.pieces[i], start_s + step_s * static_cast<double>(i));
    if (fault != feasibility::EdgeFault::kNone) {
      return fault;
    }
  }
  return feasibility::EdgeFault::kNone;
}

bool LocalOptimizer::repair(const feasibility::EdgeCheck& check, const trajectory::Piece& edge,
                            double start_s, RepairedEdge& repaired) const {
  const auto n = std::size_t{kSegments};
  double step = edge.duration_s / static_cast<double>(n);
  Knots knots;
  for (std::size_t k = 0; k <= n; ++k) {
    const vessel::FlatPoint z = edge.flat(step * static_cast<double>(k));
    knots[k] << z.position, z.velocity, z.acceleration;
  }
  Pulls pulls;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < kPoints; ++k) {
      const vessel::FlatPoint z =
          edge.flat(step * (static_cast<double>(i) + (static_cast<double>(k) + 0.5) / kPoints));
      pulls[i][k].target << z.position, z.velocity, z.acceleration;
      pulls[i][k].weight.setZero();
    }
  }
  double growth = 1.0;
  for (int attempt = 0; attempt < kSolutions; ++attempt) {
    pullTowards(check, knots, step, growth, pulls);
    solve(pulls, step, knots);
    const feasibility::EdgeFault fault = join(check, knots, start_s, step, repaired);
    if (fault == feasibility::EdgeFault::kNone) {
      return true;
    }
    if (fault != feasibility::EdgeFault::kClearance) {
      step *= kStretch;
    }
    growth *= kRaise;
  }
  return false;
}

}  // namespace otter_nav::optimizer
