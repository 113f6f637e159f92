// The objective F of the global optimisation over a spline of degree 7, and its quadratic model.
//
//   F = sum over pieces of
//       lt T + ll length + ls fs + lo fo                    (paper: f_s smoothness, f_o original)
//     + lc sum max(0, clearance aimed at - distance)^2      (paper: f_c)
//     + ld sum max(0, limit exceeded, normalised)^2         (paper: f_d; both thrusters, speed,
//     ...)
//
// Unknowns: each knot's position, velocity, acceleration and jerk, and each piece's duration.
// Every term is a square (Gauss-Newton) but time and length, whose curvature is known to be
// positive; so the model is convex, and block-tridiagonal: a block is a knot and the piece after.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/trajectory/polynomial/block_tridiagonal.hpp"
#include "otter_nav/trajectory/polynomial/hermite_basis.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

using trajectory::BasisMatrix;
using trajectory::kEndValues;
using trajectory::kOrders;
using trajectory::kQuadraturePoints;
using trajectory::ScaledBasis;

constexpr int kBlockSize = 9;  // p, v, a, j of a knot (x and y each) and the duration
using System = trajectory::BlockTridiagonal<kBlockSize>;

// How an end's state depends, to first order, on the two parameters of the manoeuvre it joins.
struct EndFamily {
  Eigen::Matrix<double, 8, 2> state = Eigen::Matrix<double, 8, 2>::Zero();  // p, v, a, j
  Eigen::Vector2d duration_s = Eigen::Vector2d::Zero();                     // of the manoeuvre
  Eigen::Vector2d reach = Eigen::Vector2d::Ones();  // steps beyond this are not to be trusted
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();  // steps made so far
};

// A joint of two pieces.
struct Knot {
  Eigen::Matrix<double, 2, 4> state = Eigen::Matrix<double, 2, 4>::Zero();  // p, v, a, j
  bool free = true;
  std::optional<EndFamily> family;  // of a knot that is not free: fixed without
};

struct Span {
  double duration_s = 1.0;
  bool duration_free = true;
};

struct Spline {
  std::vector<Knot> knots;
  std::vector<Span> spans;  // one less
};

struct SplineWeights {
  double time = 1.0;
  double length = 0.1;
  double smooth = 0.01;
  double clearance = 20.0;
  double dynamics = 20.0;
  double original = 0.0;
};

// What the hinges aim at.
struct SplineLimits {
  double clearance_m = 1.0;       // by DistanceField::smooth, of the hull's centre
  double hull_offset_m = 0.0;     // of two circles ahead and astern of it; 0: not watched
  double hull_clearance_m = 0.0;  // of those circles' centres
  double thrust_ahead_n = 50.0;   // per side
  double thrust_astern_n = 50.0;
  double speed_mps = 4.8;
  double yaw_rate_radps = 1.2;
  double heading_force_n = 8.0;  // least |w|
};

// Points that attract the spline (f_o): one a quadrature point of each piece.
using Originals = std::vector<std::array<Eigen::Vector2d, kQuadraturePoints>>;

class SplineProblem {
 public:
  explicit SplineProblem(const vessel::Parameters& vessel);

  SplineWeights weights;
  SplineLimits limits;
  // Not owned; null or empty: no such term.
  const map::DistanceField* field = nullptr;
  const Originals* originals = nullptr;

  // F; with `system`, also its quadratic model: diagonal and below hold the Hessian, right the
  // negative gradient, with what is not free pinned to zero.
  double evaluate(const Spline& spline, System* system) const;

  // Adds a step to the unknowns.
  static void apply(const std::vector<System::Vector>& step, double scale, Spline& spline);

 private:
  static constexpr int kClearancePoints = 12;
  struct Local;

  void addPiece(const Spline& spline, std::size_t i, Local& local) const;
  void addQuadraturePoint(std::size_t i, int point, Local& local) const;
  void addFree(const Eigen::Matrix<double, 2, kOrders>& z, Local& local) const;
  void addClearance(int point, Local& local) const;

  vessel::Parameters vessel_;
  std::array<BasisMatrix, kQuadraturePoints> quadrature_;
  std::array<BasisMatrix, kClearancePoints> clearance_;
};

}  // namespace otter_nav::optimizer
