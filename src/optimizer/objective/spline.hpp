// A spline of degree 7 as the optimiser moves it: each knot's position, velocity, acceleration and
// jerk, and each piece's duration.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "otter_nav/trajectory/polynomial/block_tridiagonal.hpp"
#include "otter_nav/trajectory/polynomial/quadrature.hpp"

namespace otter_nav::optimizer {

constexpr int kBlockSize = 9;  // p, v, a, j of a knot (x and y each) and the duration after it
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

// Points that attract the spline: one a quadrature point of each piece.
using Originals = std::vector<std::array<Eigen::Vector2d, trajectory::kLobattoPoints>>;

}  // namespace otter_nav::optimizer
