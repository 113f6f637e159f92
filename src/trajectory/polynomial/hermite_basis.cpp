#include "otter_nav/trajectory/polynomial/hermite_basis.hpp"

namespace otter_nav::trajectory {
namespace {

// Coefficients of s^0..s^7 (rows) of each basis function (columns), see trajectory::hermitePiece.
Eigen::Matrix<double, 8, kEndValues> basisCoefficients() {
  Eigen::Matrix<double, 8, kEndValues> c;
  c << 1, 0, 0, 0, 0, 0, 0, 0,                         //
      0, 1, 0, 0, 0, 0, 0, 0,                          //
      0, 0, 0.5, 0, 0, 0, 0, 0,                        //
      0, 0, 0, 1.0 / 6, 0, 0, 0, 0,                    //
      -35, -20, -5, -2.0 / 3, 35, -15, 2.5, -1.0 / 6,  //
      84, 45, 10, 1, -84, 39, -7, 0.5,                 //
      -70, -36, -7.5, -2.0 / 3, 70, -34, 6.5, -0.5,    //
      20, 10, 2, 1.0 / 6, -20, 10, -2, 1.0 / 6;
  return c;
}

}  // namespace

BasisMatrix hermiteBasis(double s) {
  const Eigen::Matrix<double, 8, kEndValues> c = basisCoefficients();
  BasisMatrix basis = BasisMatrix::Zero();
  for (int d = 0; d < kOrders; ++d) {
    double power = 1.0;
    for (int k = d; k < 8; ++k) {
      double factor = power;
      for (int i = 0; i < d; ++i) {
        factor *= k - i;
      }
      basis.row(d) += factor * c.row(k);
      power *= s;
    }
  }
  return basis;
}

const std::array<double, kQuadraturePoints>& quadraturePoints() {
  constexpr double kA = 0.5 * 0.8717401485096066;
  constexpr double kB = 0.5 * 0.5917001814331423;
  constexpr double kC = 0.5 * 0.2092992179024789;
  static constexpr std::array<double, kQuadraturePoints> kPoints = {
      0.0, 0.5 - kA, 0.5 - kB, 0.5 - kC, 0.5 + kC, 0.5 + kB, 0.5 + kA, 1.0};
  return kPoints;
}

const std::array<double, kQuadraturePoints>& quadratureWeights() {
  constexpr double kA = 0.5 * 0.2107042271435061;
  constexpr double kB = 0.5 * 0.3411226924835044;
  constexpr double kC = 0.5 * 0.4124587946587038;
  constexpr double kEnd = 0.5 / 28.0;
  static constexpr std::array<double, kQuadraturePoints> kWeights = {kEnd, kA, kB, kC,
                                                                     kC,   kB, kA, kEnd};
  return kWeights;
}

ScaledBasis scaleBasis(const BasisMatrix& basis, double duration_s) {
  const double inverse = 1.0 / duration_s;
  // T^(m - d) for m in 0..3 and d in 0..4: powers -4 to 3.
  std::array<double, 8> power{};
  power[4] = 1.0;
  for (int i = 5; i < 8; ++i) {
    power[static_cast<std::size_t>(i)] = power[static_cast<std::size_t>(i - 1)] * duration_s;
  }
  for (int i = 3; i >= 0; --i) {
    power[static_cast<std::size_t>(i)] = power[static_cast<std::size_t>(i + 1)] * inverse;
  }
  ScaledBasis scaled;
  for (int m = 0; m < kEndValues; ++m) {
    for (int d = 0; d < kOrders; ++d) {
      const int exponent = m % 4 - d;
      scaled.value(d, m) = basis(d, m) * power[static_cast<std::size_t>(exponent + 4)];
      scaled.slope(d, m) = exponent * inverse * scaled.value(d, m);
    }
  }
  return scaled;
}

}  // namespace otter_nav::trajectory
