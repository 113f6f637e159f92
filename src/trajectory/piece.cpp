#include "otter_nav/trajectory/piece.hpp"

namespace otter_nav::trajectory {
namespace {

// Horner's scheme for a polynomial and its first four derivatives, each divided by k!.
template <int Rows>
struct Taylor {
  Eigen::Matrix<double, Rows, 1> value[5];
};

template <int Rows>
Taylor<Rows> expand(const Eigen::Matrix<double, Rows, kCoefficients>& c, double t) {
  Taylor<Rows> taylor;
  for (auto& v : taylor.value) {
    v.setZero();
  }
  for (int k = kDegree; k >= 0; --k) {
    for (int d = 4; d > 0; --d) {
      taylor.value[d] = taylor.value[d] * t + taylor.value[d - 1];
    }
    taylor.value[0] = taylor.value[0] * t + c.col(k);
  }
  return taylor;
}

}  // namespace

vessel::FlatPoint Piece::flat(double t_s) const {
  vessel::FlatPoint z;
  const Taylor<2> taylor = expand<2>(position, t_s);
  z.position = taylor.value[0];
  z.velocity = taylor.value[1];
  z.acceleration = 2.0 * taylor.value[2];
  z.jerk = 6.0 * taylor.value[3];
  z.snap = 24.0 * taylor.value[4];
  return z;
}

Eigen::Vector3d Piece::spinHeading(double t_s) const {
  const Taylor<1> taylor = expand<1>(heading, t_s);
  return {taylor.value[0][0], taylor.value[1][0], 2.0 * taylor.value[2][0]};
}

Piece spinPiece(const Eigen::Vector2d& position, double psi_start_rad, double psi_end_rad,
                double duration_s) {
  Piece piece;
  piece.kind = PieceKind::kSpin;
  piece.duration_s = duration_s;
  piece.position.col(0) = position;
  const double turn = psi_end_rad - psi_start_rad;
  const double T3 = duration_s * duration_s * duration_s;
  piece.heading[0] = psi_start_rad;
  piece.heading[3] = 10.0 * turn / T3;
  piece.heading[4] = -15.0 * turn / (T3 * duration_s);
  piece.heading[5] = 6.0 * turn / (T3 * duration_s * duration_s);
  return piece;
}

}  // namespace otter_nav::trajectory
