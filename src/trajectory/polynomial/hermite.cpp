#include "otter_nav/trajectory/polynomial/hermite.hpp"

#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/trajectory/polynomial/quadrature.hpp"

namespace otter_nav::trajectory {
namespace {

// Coefficients of s^0, s^1, ... (rows) of each basis function (columns), as in hermitePiece.
Eigen::Matrix<double, 8, 8> septicCoefficients() {
  Eigen::Matrix<double, 8, 8> c;
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

Eigen::Matrix<double, 6, 6> quinticCoefficients() {
  Eigen::Matrix<double, 6, 6> c;
  c << 1, 0, 0, 0, 0, 0,           //
      0, 1, 0, 0, 0, 0,            //
      0, 0, 0.5, 0, 0, 0,          //
      -10, -6, -1.5, 10, -4, 0.5,  //
      15, 8, 1.5, -15, 7, -1,      //
      -6, -3, -0.5, 6, -3, 0.5;
  return c;
}

template <int Orders, int Size>
Eigen::Matrix<double, Orders, Size> basisAt(const Eigen::Matrix<double, Size, Size>& c, double s) {
  Eigen::Matrix<double, Orders, Size> basis = Eigen::Matrix<double, Orders, Size>::Zero();
  for (int d = 0; d < Orders; ++d) {
    double power = 1.0;
    for (int k = d; k < Size; ++k) {
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

}  // namespace

SepticBasis septicBasis(double s) {
  return basisAt<kSepticOrders, kSepticEnds>(septicCoefficients(), s);
}

QuinticBasis quinticBasis(double s) {
  return basisAt<3, 6>(quinticCoefficients(), s);
}

Eigen::Matrix<double, 6, 6> quinticJerk() {
  const Eigen::Matrix<double, 6, 6> c = quinticCoefficients();
  Eigen::Matrix<double, 6, 6> jerk = Eigen::Matrix<double, 6, 6>::Zero();
  for (int i = 3; i < 6; ++i) {
    for (int k = 3; k < 6; ++k) {
      const double factor = i * (i - 1.0) * (i - 2.0) * k * (k - 1.0) * (k - 2.0) / (i + k - 5.0);
      jerk += factor * c.row(i).transpose() * c.row(k);
    }
  }
  return jerk;
}

SepticBasis scaleBasis(const SepticBasis& basis, double duration_s) {
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
  SepticBasis scaled;
  for (int m = 0; m < kSepticEnds; ++m) {
    for (int d = 0; d < kSepticOrders; ++d) {
      scaled(d, m) = basis(d, m) * power[static_cast<std::size_t>(m % 4 - d + 4)];
    }
  }
  return scaled;
}

SepticBasis byDuration(const SepticBasis& scaled, double duration_s) {
  const double inverse = 1.0 / duration_s;
  SepticBasis slope;
  for (int m = 0; m < kSepticEnds; ++m) {
    for (int d = 0; d < kSepticOrders; ++d) {
      slope(d, m) = (m % 4 - d) * inverse * scaled(d, m);
    }
  }
  return slope;
}

Piece hermitePiece(const vessel::FlatPoint& start, const vessel::FlatPoint& end,
                   double duration_s) {
  const double T = duration_s;
  const double T2 = T * T;
  const double T3 = T2 * T;
  Piece piece;
  piece.duration_s = T;
  piece.position.col(0) = start.position;
  piece.position.col(1) = start.velocity;
  piece.position.col(2) = start.acceleration / 2.0;
  piece.position.col(3) = start.jerk / 6.0;
  // What the cubic start leaves open at the end, scaled to unit time.
  const Eigen::Vector2d dp = end.position - (start.position + start.velocity * T +
                                             start.acceleration * (T2 / 2) + start.jerk * (T3 / 6));
  const Eigen::Vector2d dv =
      (end.velocity - (start.velocity + start.acceleration * T + start.jerk * (T2 / 2))) * T;
  const Eigen::Vector2d da = (end.acceleration - (start.acceleration + start.jerk * T)) * T2;
  const Eigen::Vector2d dj = (end.jerk - start.jerk) * T3;
  const double T4 = T2 * T2;
  piece.position.col(4) = (35.0 * dp - 15.0 * dv + 2.5 * da - dj / 6.0) / T4;
  piece.position.col(5) = (-84.0 * dp + 39.0 * dv - 7.0 * da + 0.5 * dj) / (T4 * T);
  piece.position.col(6) = (70.0 * dp - 34.0 * dv + 6.5 * da - 0.5 * dj) / (T4 * T2);
  piece.position.col(7) = (-20.0 * dp + 10.0 * dv - 2.0 * da + dj / 6.0) / (T4 * T3);
  return piece;
}

Piece quinticPiece(const QuinticEnd& start, const QuinticEnd& end, double duration_s) {
  const double T = duration_s;
  const double T2 = T * T;
  const double T5 = T2 * T2 * T;
  const Eigen::Vector2d dp = end.col(0) - start.col(0) - start.col(1) * T - start.col(2) * (T2 / 2);
  const Eigen::Vector2d dv = end.col(1) - start.col(1) - start.col(2) * T;
  const Eigen::Vector2d da = end.col(2) - start.col(2);
  const Eigen::Vector2d alpha = (720.0 * dp - 360.0 * T * dv + 60.0 * T2 * da) / T5;
  const Eigen::Vector2d beta = (-360.0 * T * dp + 168.0 * T2 * dv - 24.0 * T2 * T * da) / T5;
  const Eigen::Vector2d gamma = (60.0 * T2 * dp - 24.0 * T2 * T * dv + 3.0 * T2 * T2 * da) / T5;
  Piece piece;
  piece.duration_s = T;
  piece.position.leftCols<2>() = start.leftCols<2>();
  piece.position.col(2) = start.col(2) / 2.0;
  piece.position.col(3) = gamma / 6.0;
  piece.position.col(4) = beta / 24.0;
  piece.position.col(5) = alpha / 120.0;
  return piece;
}

double squaredJerk(const Piece& piece) {
  const double half = 0.5 * piece.duration_s;
  double sum = 0.0;
  for (std::size_t k = 0; k < kGauss.at.size(); ++k) {
    sum += kGauss.weight[k] * half * piece.flat(half * (1.0 + kGauss.at[k])).jerk.squaredNorm();
  }
  return sum;
}

}  // namespace otter_nav::trajectory
