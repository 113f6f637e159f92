#pragma once

#include "otter_nav/base/planar.hpp"
#include "otter_nav/trajectory/polynomial/hermite.hpp"

namespace otter_nav::trajectory {

// Ahead or astern from rest to rest; the heading is its own: astern it can't follow.
[[nodiscard]] inline Piece straightLeg(const Eigen::Vector2d& start, double psi_rad, double ahead_m,
                                       double duration_s) {
  vessel::FlatPoint from;
  from.position = start;
  vessel::FlatPoint to;
  to.position = start + ahead_m * unitVector(psi_rad);
  Piece piece = hermitePiece(from, to, duration_s);
  piece.kind = PieceKind::kSpin;
  piece.heading[0] = psi_rad;
  return piece;
}

}  // namespace otter_nav::trajectory
