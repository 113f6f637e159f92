// Hermite's basis of degree 5 (ends p, v, a) and 7 (p, v, a, j) on the unit interval: position and
// derivatives of a piece as linear functions of its end states and, of degree 7, of its duration.
//
//   z^(d)(s T) = sum over m of T^(order of c_m - d) H_m^(d)(s) c_m,  c = [p0 v0 ... p1 v1 ...]
#pragma once

#include <Eigen/Core>

namespace otter_nav::trajectory {

constexpr int kSepticOrders = 5;  // position to snap
constexpr int kSepticEnds = 8;    // p, v, a, j at both ends

// H_m^(d)(s), row d, column m.
using SepticBasis = Eigen::Matrix<double, kSepticOrders, kSepticEnds>;
[[nodiscard]] SepticBasis septicBasis(double s);
using QuinticBasis = Eigen::Matrix<double, 3, 6>;
[[nodiscard]] QuinticBasis quinticBasis(double s);
// The integral of a quintic's squared third derivative, a quadratic form of its end values.
[[nodiscard]] Eigen::Matrix<double, 6, 6> quinticJerk();

// A piece's basis at one point for its duration: maps end values to derivatives.
[[nodiscard]] SepticBasis scaleBasis(const SepticBasis& basis, double duration_s);
// Its derivative with respect to the duration.
[[nodiscard]] SepticBasis byDuration(const SepticBasis& scaled, double duration_s);

}  // namespace otter_nav::trajectory
