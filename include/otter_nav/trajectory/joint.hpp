// What makes pieces a trajectory: each has a duration and finite coefficients, and begins where the
// one before it ends. Whoever takes a trajectory says how wide a gap may be.
#pragma once

#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/trajectory/piece.hpp"

namespace otter_nav::trajectory {

// Between a piece's end and the next one's beginning, in size.
struct Gap {
  double position_m = 0.0;
  double velocity_mps = 0.0;
  double acceleration_mps2 = 0.0;
  double jerk_mps3 = 0.0;
};
[[nodiscard]] Gap gapBetween(const Piece& before, const Piece& after);

// Finite, with a positive duration.
[[nodiscard]] bool isSound(const Piece& piece);

// Without motion at its end, nor turning on, if its heading is its own.
[[nodiscard]] bool endsAtRest(const Piece& piece);

// Errors name the piece and the fault. Gaps of position and velocity alone count.
[[nodiscard]] Status checkPieces(const std::vector<Piece>& pieces, const Gap& largest);

}  // namespace otter_nav::trajectory
