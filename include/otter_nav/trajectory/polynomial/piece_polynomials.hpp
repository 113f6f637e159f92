// Polynomials of a trajectory's piece: derivatives, values, the line it lies on, a bound of its
// speed.
#pragma once

#include <Eigen/Core>

#include "otter_nav/trajectory/piece.hpp"

namespace otter_nav::trajectory {

template <int Columns>
Eigen::Matrix<double, 2, Columns - 1> differentiate(const Eigen::Matrix<double, 2, Columns>& c) {
  Eigen::Matrix<double, 2, Columns - 1> d;
  for (int k = 1; k < Columns; ++k) {
    d.col(k - 1) = k * c.col(k);
  }
  return d;
}

template <int Columns>
Eigen::Vector2d evaluate(const Eigen::Matrix<double, 2, Columns>& c, double t) {
  Eigen::Vector2d value = c.col(Columns - 1);
  for (int k = Columns - 2; k >= 0; --k) {
    value = value * t + c.col(k);
  }
  return value;
}

// The direction all of a piece's motion is along, or zero.
[[nodiscard]] Eigen::Vector2d lineOf(const Piece& piece);

// No less than the speed anywhere on the piece.
[[nodiscard]] double speedBound(const Eigen::Matrix<double, 2, 7>& velocity, double duration_s);

}  // namespace otter_nav::trajectory
