// What every cost and constraint of the objective is: a class that adds its value at a point of the
// spline, and its gradient where that is wanted. SplineProblem's constructor lists them.
//
// Every term is a square (Gauss-Newton) or convex in what it adds, so that the model stays convex.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "optimizer/objective/spline.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/trajectory/polynomial/hermite.hpp"
#include "otter_nav/vessel/inverse_dynamics.hpp"

namespace otter_nav::optimizer {

// A cell's square reaches this far beyond its centre, in cells (DistanceField::smooth measures to
// centres), as seen from most directions.
constexpr double kSquareCells = 0.7;
constexpr double kSlowMps = 0.5;  // at less, what a course turns by is bounded

struct SplineWeights {
  double time = 0.0;
  double length = 0.0;
  double smooth = 0.0;
  double clearance = 0.0;
  double dynamics = 0.0;
  double original = 0.0;
  double room = 0.0;
  double hull_room = 0.0;
};

// What the penalties leave unpunished.
struct SplineLimits {
  double clearance_m = 0.0;          // by Obstacles::smooth, of the hull's centre
  double room_m = 0.0;               // the same, preferred
  double hull_offset_m = 0.0;        // of two circles ahead and astern of it; 0: not watched
  double hull_clearance_m = 0.0;     // of those circles' centres
  double hull_room_m = 0.0;          // the same, preferred
  double leaning_clearance_m = 0.0;  // the same of the hull as it leans
  double thrust_ahead_n = 0.0;       // per side
  double thrust_astern_n = 0.0;
  double speed_mps = 0.0;
  feasibility::SlowingDown slowing;  // of a vessel that is faster
  double yaw_rate_radps = 0.0;
  double heading_force_n = 0.0;  // least |w|

  // What lies farther from the hull's centre costs nothing; and nothing but for room preferred.
  [[nodiscard]] double reach_m() const { return std::max(room_m, near_m()); }
  [[nodiscard]] double near_m() const {
    return std::max(clearance_m, hull_offset_m > 0.0
                                     ? hull_offset_m + std::max(hull_clearance_m, hull_room_m)
                                     : 0.0);
  }
};

// What the terms are to reach, and among what.
struct Targets {
  SplineWeights weights;
  SplineLimits limits;
  double start_s = 0.0;  // the spline's start, on the obstacles' clock
  double clock = 1.0;    // seconds of that for one of the spline
  // Not owned; null: no such term.
  const feasibility::Obstacles* obstacles = nullptr;
  // Those of them that lie still, where some move: for pieces that meet nothing that does. Null:
  // all are asked.
  const feasibility::Obstacles* still = nullptr;
  const Originals* originals = nullptr;
  const vessel::InverseDynamics* leaning = nullptr;  // into a load that isn't planned with
  // The limits' curvature across course and force counts in the model, beside the squares.
  bool knows_curvature = false;
  // Of each thruster's limits, kept back for what the objective's model leaves out; one a
  // quadrature point of each piece, or empty.
  std::vector<std::array<double, trajectory::kLobattoPoints>> kept_n;

  [[nodiscard]] double keptAt(std::size_t piece, std::size_t point) const {
    return kept_n.empty() ? 0.0 : kept_n[piece][point];
  }
};

// Derivatives of a scalar by position, velocity, acceleration, jerk and snap (columns).
using Rows = Eigen::Matrix<double, 2, trajectory::kSepticOrders>;

// One piece's share of the model: unknowns are 8 of its first knot, its duration, 8 of the second.
struct PieceModel {
  static constexpr int kUnknowns = 17;
  static constexpr int kDuration = 8;
  using Vector = Eigen::Matrix<double, kUnknowns, 1>;

  std::size_t index = 0;
  Eigen::Matrix<double, 2, trajectory::kSepticEnds> ends;
  double start_s = 0.0;  // and
  double clock = 1.0;    // as in Targets
  double duration_s = 1.0;
  const feasibility::Obstacles* obstacles = nullptr;  // of Targets, those that count here
  bool wanted = false;                                // gradient and Hessian
  double cost = 0.0;
  Vector gradient;
  Eigen::Matrix<double, kUnknowns, kUnknowns> hessian;  // lower triangle

  void addCurvature(double curvature, const Vector& j) {
    addColumns(curvature, j, std::make_integer_sequence<int, kUnknowns>());
  }
  void addSquare(double weight, double residual, const Vector& j) {
    gradient += 2.0 * weight * residual * j;
    addCurvature(2.0 * weight, j);
  }

 private:
  template <int... Columns>
  void addColumns(double curvature, const Vector& j,
                  std::integer_sequence<int, Columns...> /*all*/) {
    (addColumn<Columns>(curvature, j), ...);
  }
  // Half of a derivative of one axis is zero.
  template <int Column>
  void addColumn(double curvature, const Vector& j) {
    if (j[Column] != 0.0) {
      hessian.col(Column).tail<kUnknowns - Column>() +=
          (curvature * j[Column]) * j.tail<kUnknowns - Column>();
    }
  }
};

// A point of a piece: what a term may ask of it, and where it adds what it costs. Computed as far
// as it is asked for.
class Point {
 public:
  // `unit` is the basis at `at` of the unit interval; `part` the point's part of the duration.
  Point(const trajectory::SepticBasis& unit, std::size_t index, double at, double part,
        const vessel::InverseDynamics& motion, double floor_n, PieceModel& model)
      : number(index),
        share(part),
        time_s(model.start_s + at * model.duration_s * model.clock),
        dynamics(motion),
        force_floor_n(floor_n),
        piece(model),
        unit_(unit) {}

  const std::size_t number;  // of the piece's quadrature points
  const double share;
  const double time_s;  // on the obstacles' clock
  const vessel::InverseDynamics& dynamics;
  const double force_floor_n;  // |w| below this is treated as this
  PieceModel& piece;

  [[nodiscard]] double dt() const { return piece.duration_s * share; }
  // Without the derivatives.
  [[nodiscard]] Eigen::Vector2d position() const {
    Eigen::Vector2d p = Eigen::Vector2d::Zero();
    double power = 1.0;
    for (int m = 0; m < 4; ++m) {
      p += power * (unit_(0, m) * piece.ends.col(m) + unit_(0, m + 4) * piece.ends.col(m + 4));
      power *= piece.duration_s;
    }
    return p;
  }
  // Position to snap.
  [[nodiscard]] const Rows& path() {
    if (!has_path_) {
      basis_ = trajectory::scaleBasis(unit_, piece.duration_s);
      path_.noalias() = piece.ends * basis_.transpose();
      if (piece.wanted) {
        slope_.noalias() =
            piece.ends * trajectory::byDuration(basis_, piece.duration_s).transpose();
      }
      has_path_ = true;
    }
    return path_;
  }
  // Thrusts and yaw rate, with gradients where they are wanted.
  [[nodiscard]] const vessel::FlatGradient& demand() {
    if (!has_demand_) {
      vessel::FlatPoint flat;
      flat.velocity = path().col(1);
      flat.acceleration = path_.col(2);
      flat.jerk = path_.col(3);
      flat.snap = path_.col(4);
      demand_ = piece.wanted ? dynamics.gradient(flat, force_floor_n)
                             : dynamics.demand(flat, force_floor_n);
      has_demand_ = true;
    }
    return demand_;
  }

  // d scalar / d unknowns from d scalar / d derivatives; path() has been asked for and gradients
  // are wanted.
  [[nodiscard]] PieceModel::Vector chain(const Rows& rows) const {
    const Eigen::Matrix<double, 2, trajectory::kSepticEnds> by_ends = rows * basis_;
    PieceModel::Vector j;
    for (int m = 0; m < 4; ++m) {
      j.segment<2>(2 * m) = by_ends.col(m);
      j.segment<2>(9 + 2 * m) = by_ends.col(m + 4);
    }
    j[PieceModel::kDuration] = rows.cwiseProduct(slope_).sum();
    return j;
  }
  // Of a scalar that depends on one derivative alone: 0 is position, 4 snap.
  [[nodiscard]] PieceModel::Vector chain(int order, const Eigen::Vector2d& by) const {
    PieceModel::Vector j;
    for (int m = 0; m < 4; ++m) {
      j.segment<2>(2 * m) = basis_(order, m) * by;
      j.segment<2>(9 + 2 * m) = basis_(order, m + 4) * by;
    }
    j[PieceModel::kDuration] = by.dot(slope_.col(order));
    return j;
  }
  // weight * max(0, excess)^2, growing linearly from `knee` on (Huber), so that a bad first guess
  // does not drown all else; `rows` makes the derivative of excess. `weight` must not depend on the
  // unknowns: a mean over the piece takes `share`, not dt().
  template <typename MakeRows>
  void addHinge(double weight, double excess, double knee, const MakeRows& rows) {
    addChained(weight, excess, knee, [&] { return chain(rows()); });
  }
  // The same where it depends on one derivative alone.
  template <typename MakeGradient>
  void addHinge(double weight, double excess, double knee, int order, const MakeGradient& by) {
    addChained(weight, excess, knee, [&] { return chain(order, by()); });
  }

 private:
  template <typename MakeVector>
  void addChained(double weight, double excess, double knee, const MakeVector& gradient) {
    if (excess <= 0.0) {
      return;
    }
    const double held = std::min(excess, knee);
    piece.cost += weight * held * (2.0 * excess - held);
    if (piece.wanted) {
      piece.addSquare(weight * held / excess, excess, gradient());
    }
  }

  const trajectory::SepticBasis& unit_;
  bool has_path_ = false;
  bool has_demand_ = false;
  trajectory::SepticBasis basis_;
  Rows slope_;  // of the path with respect to the duration
  Rows path_;
  vessel::FlatGradient demand_;
};

class Cost {
 public:
  virtual ~Cost() = default;
  virtual void add(const Targets& targets, Point& point) const = 0;
};

}  // namespace otter_nav::optimizer
