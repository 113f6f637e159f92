// What a voyage costs by itself: its time, its length, its jerk, and, while the first shape is
// found, how far it strays from the path given.
#pragma once

#include <algorithm>

#include "optimizer/objective/cost.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::optimizer {

// lt T. Linear; its model is bent as much as keeps a step from shrinking the piece to nothing.
class TimeCost final : public Cost {
 public:
  void add(const Targets& targets, Point& point) const override {
    PieceModel& piece = point.piece;
    const double weight = targets.weights.time * point.share;
    piece.cost += weight * piece.duration_s;
    if (piece.wanted) {
      constexpr int kT = PieceModel::kDuration;
      piece.gradient[kT] += weight;
      piece.hessian(kT, kT) += 0.5 * weight / piece.duration_s;
    }
  }
};

// ls times the integral of |z'''|^2 (the paper's f_s).
class SmoothnessCost final : public Cost {
 public:
  void add(const Targets& targets, Point& point) const override {
    PieceModel& piece = point.piece;
    const Eigen::Vector2d jerk = point.path().col(3);
    const double weight = targets.weights.smooth * point.dt();
    piece.cost += weight * jerk.squaredNorm();
    for (int axis = 0; axis < 2 && piece.wanted; ++axis) {
      PieceModel::Vector j = point.chain(3, Eigen::Vector2d::Unit(axis));
      j[PieceModel::kDuration] += 0.5 / piece.duration_s * jerk[axis];
      piece.addSquare(weight, jerk[axis], j);
    }
  }
};

// ll times the integral of |z'|, whose curvature across the course is known.
class LengthCost final : public Cost {
 public:
  void add(const Targets& targets, Point& point) const override {
    PieceModel& piece = point.piece;
    const Eigen::Vector2d velocity = point.path().col(1);
    const double speed = velocity.norm();
    const double weight = targets.weights.length * point.dt();
    piece.cost += weight * speed;
    if (!piece.wanted || speed <= 1e-6) {
      return;
    }
    const Eigen::Vector2d course = velocity / speed;
    piece.gradient += weight * point.chain(1, course);
    piece.gradient[PieceModel::kDuration] += targets.weights.length * point.share * speed;
    piece.addCurvature(weight / std::max(speed, kSlowMps), point.chain(1, across(course)));
  }
};

// lo |z - original|^2 (the paper's f_o).
class OriginalCost final : public Cost {
 public:
  void add(const Targets& targets, Point& point) const override {
    if (targets.originals == nullptr || targets.weights.original <= 0.0) {
      return;
    }
    PieceModel& piece = point.piece;
    const double weight = targets.weights.original * point.share;
    const Eigen::Vector2d off =
        point.path().col(0) - (*targets.originals)[piece.index][point.number];
    piece.cost += weight * off.squaredNorm();
    for (int axis = 0; axis < 2 && piece.wanted; ++axis) {
      piece.addSquare(weight, off[axis], point.chain(0, Eigen::Vector2d::Unit(axis)));
    }
  }
};

}  // namespace otter_nav::optimizer
