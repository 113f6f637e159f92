// What a voyage costs by itself: its time, its length, its jerk, and, while the first shape is
// found, how far it strays from the path given.
#pragma once

#include <algorithm>

#include "optimizer/objective/cost.hpp"
#include "otter_nav/base/planar.hpp"

namespace otter_nav::optimizer {

// lt T. Linear; its model is bent as much as keeps a step from shrinking the piece to nothing.
class TimeCost : public Cost {
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
class SmoothnessCost : public Cost {
 public:
  void add(const Targets& targets, Point& point) const override {
    PieceModel& piece = point.piece;
    const Eigen::Vector2d jerk = point.path().col(3);
    const double weight = targets.weights.smooth * point.dt();
    piece.cost += weight * jerk.squaredNorm();
    for (int axis = 0; axis < 2 && piece.wanted; ++axis) {
      Rows rows = Rows::Zero();
      rows(axis, 3) = 1.0;
      PieceModel::Vector j = point.chain(rows);
      j[PieceModel::kDuration] += 0.5 / piece.duration_s * jerk[axis];
      piece.addSquare(weight, jerk[axis], j);
    }
  }
};

// ll times the integral of |z'|, whose curvature across the course is known.
class LengthCost : public Cost {
 public:
  void add(const Targets& targets, Point& point) const override {
    constexpr double kSlowMps = 0.5;  // below it the curvature is bounded
    PieceModel& piece = point.piece;
    const Eigen::Vector2d velocity = point.path().col(1);
    const double speed = velocity.norm();
    const double weight = targets.weights.length * point.dt();
    piece.cost += weight * speed;
    if (!piece.wanted || speed <= 1e-6) {
      return;
    }
    Rows rows = Rows::Zero();
    rows.col(1) = velocity / speed;
    piece.gradient += weight * point.chain(rows);
    piece.gradient[PieceModel::kDuration] += targets.weights.length * point.share * speed;
    rows.col(1) = across(rows.col(1));
    piece.addCurvature(weight / std::max(speed, kSlowMps), point.chain(rows));
  }
};

// lo |z - original|^2 (the paper's f_o).
class OriginalCost : public Cost {
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
      Rows rows = Rows::Zero();
      rows(axis, 0) = 1.0;
      piece.addSquare(weight, off[axis], point.chain(rows));
    }
  }
};

}  // namespace otter_nav::optimizer
