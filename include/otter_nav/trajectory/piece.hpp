// One polynomial piece of a trajectory: sailing (position of degree 7 in time, the heading follows
// from it) or a spin (position and heading of degree 7), for what the flat output cannot express:
// turning on the spot, and getting under way or stopping while turning.
#pragma once

#include <Eigen/Core>

#include "otter_nav/vessel/types.hpp"

namespace otter_nav::trajectory {

constexpr int kDegree = 7;
constexpr int kCoefficients = kDegree + 1;

enum class PieceKind { kSail, kSpin };

struct Piece {
  PieceKind kind = PieceKind::kSail;
  double duration_s = 0.0;
  // z(t) = sum of column k times t^k, t in [0, duration] s; on the spot only column 0 is not zero.
  Eigen::Matrix<double, 2, kCoefficients> position =
      Eigen::Matrix<double, 2, kCoefficients>::Zero();
  // Spin only: psi(t), continuous (not wrapped), same form.
  Eigen::Matrix<double, 1, kCoefficients> heading = Eigen::Matrix<double, 1, kCoefficients>::Zero();

  // z and its derivatives at `t_s` from the piece's start; outside [0, duration] it extrapolates.
  [[nodiscard]] vessel::FlatPoint flat(double t_s) const;
  // psi and its first two derivatives of a spin.
  [[nodiscard]] Eigen::Vector3d spinHeading(double t_s) const;
};

// The degree-7 piece through two points with their velocities, accelerations and jerks.
[[nodiscard]] Piece hermitePiece(const vessel::FlatPoint& start, const vessel::FlatPoint& end,
                                 double duration_s);
// Position, velocity and acceleration (columns) of an end of a quintic.
using QuinticEnd = Eigen::Matrix<double, 2, 3>;
// The quintic of least integral of |jerk|^2 between two ends (alpha, beta, gamma of Mueller et al.
// 2015 as polynomial coefficients).
[[nodiscard]] Piece quinticPiece(const QuinticEnd& start, const QuinticEnd& end, double duration_s);
// The integral of |jerk|^2 over a piece: exact up to degree 7.
[[nodiscard]] double squaredJerk(const Piece& piece);
// A rest-to-rest spin in place; yaw rate and yaw acceleration are zero at both ends.
[[nodiscard]] Piece spinPiece(const Eigen::Vector2d& position, double psi_start_rad,
                              double psi_end_rad, double duration_s);

}  // namespace otter_nav::trajectory
