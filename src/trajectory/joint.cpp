#include "otter_nav/trajectory/joint.hpp"

#include <cmath>

#include "otter_nav/base/text.hpp"

namespace otter_nav::trajectory {

Gap gapBetween(const Piece& before, const Piece& after) {
  const vessel::FlatPoint a = before.flat(before.duration_s);
  const vessel::FlatPoint b = after.flat(0.0);
  return {(b.position - a.position).norm(), (b.velocity - a.velocity).norm(),
          (b.acceleration - a.acceleration).norm(), (b.jerk - a.jerk).norm()};
}

bool isSound(const Piece& piece) {
  return piece.duration_s > 0.0 && std::isfinite(piece.duration_s) && piece.position.allFinite() &&
         piece.heading.allFinite();
}

bool endsAtRest(const Piece& piece) {
  constexpr double kRest = 1e-3;  // m/s and rad/s
  const double end = piece.duration_s;
  return piece.flat(end).velocity.norm() < kRest &&
         (piece.kind != PieceKind::kSpin || std::abs(piece.spinHeading(end)[1]) < kRest);
}

Status checkPieces(const std::vector<Piece>& pieces, const Gap& largest) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (!(pieces[i].duration_s > 0.0)) {
      return failure(
          text("pieces[%zu]: duration is %g s, has to be positive", i, pieces[i].duration_s));
    }
    if (!isSound(pieces[i])) {
      return failure(text("pieces[%zu]: a coefficient or the duration is not finite", i));
    }
    if (i == 0) {
      continue;
    }
    const Gap gap = gapBetween(pieces[i - 1], pieces[i]);
    if (!(gap.position_m <= largest.position_m)) {
      return failure(text("pieces[%zu] begins %g m from the end of the one before (at most %g)", i,
                          gap.position_m, largest.position_m));
    }
    if (!(gap.velocity_mps <= largest.velocity_mps)) {
      return failure(text("pieces[%zu]: velocity jumps by %g m/s (at most %g)", i, gap.velocity_mps,
                          largest.velocity_mps));
    }
  }
  return {};
}

}  // namespace otter_nav::trajectory
