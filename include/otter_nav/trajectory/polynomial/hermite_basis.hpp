// The degree-7 Hermite basis at fixed points of the unit interval: position and derivatives of a
// piece as linear functions of its end states [p, v, a, j], and of those of its duration.
//
//   z^(d)(s T) = sum over m of T^(m mod 4 - d) H_m^(d)(s) c_m,  c = [p0 v0 a0 j0 p1 v1 a1 j1]
#pragma once

#include <Eigen/Core>
#include <array>

namespace otter_nav::trajectory {

constexpr int kOrders = 5;     // position to snap
constexpr int kEndValues = 8;  // p, v, a, j at both ends

using BasisMatrix = Eigen::Matrix<double, kOrders, kEndValues>;

// H_m^(d)(s), row d, column m.
[[nodiscard]] BasisMatrix hermiteBasis(double s);

// Eight Gauss-Lobatto points on [0, 1] with both ends: exact for the integral of squared jerk.
constexpr int kQuadraturePoints = 8;
[[nodiscard]] const std::array<double, kQuadraturePoints>& quadraturePoints();
[[nodiscard]] const std::array<double, kQuadraturePoints>& quadratureWeights();

// A piece's basis at one point for its duration: `value` maps end values to derivatives, `slope`
// is the derivative of `value` with respect to the duration.
struct ScaledBasis {
  BasisMatrix value;
  BasisMatrix slope;
};
[[nodiscard]] ScaledBasis scaleBasis(const BasisMatrix& basis, double duration_s);

}  // namespace otter_nav::trajectory
