// The one walk along a path that asks for clearance: nothing is stepped over, however thin. Edges,
// pieces, whole trajectories and what is left of a sailed one are walked by PieceWalk; what keeps
// to another shape (an outline) gives firstConflict a slack of its own.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "otter_nav/feasibility/hull_cover.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/trajectory/piece.hpp"
#include "otter_nav/trajectory/polynomial/piece_polynomials.hpp"

namespace otter_nav::feasibility {

// Nearer to its limit than this counts as a conflict, so that every step gets on.
constexpr double kLeastSlackM = 1e-3;

// From `from_s` on to `to_s`: `slack(t)` says how far, m, what is watched may still come nearer to
// something at time t. Neither it nor the obstacles get nearer faster than `approach_max_mps` (a
// bound of the speed of every point watched plus Obstacles::rateBound()), so the walk moves on by
// slack / approach_max_mps. The first time with less than the least slack, or nothing.
template <typename Slack>
[[nodiscard]] std::optional<double> firstConflict(double from_s, double to_s,
                                                  double approach_max_mps, const Slack& slack) {
  const double slowest = std::numeric_limits<double>::min();
  for (double t = from_s;;) {
    const double left = slack(t);
    if (!(left >= kLeastSlackM)) {
      return t;
    }
    if (t >= to_s) {
      return std::nullopt;
    }
    t = std::min(t + left / std::max(approach_max_mps, slowest), to_s);
  }
}

// What the walk along one piece came to.
struct Walked {
  std::optional<double> conflict_s;  // from the piece's start; none: it keeps clear
  double centre_m = 0.0;             // clearance of the hull's centre at the conflict
  double least_m = 0.0;              // least of those met on the way
};

// What a hull keeps along a piece: its centre `clearance_m`, and the discs that cover it
// `hull_margin_m`. A limit that changes along the way belongs into slack(), and what it adds to the
// approach into along().
class PieceWalk {
 public:
  // `whole`: the discs count too.
  explicit PieceWalk(const SafetyLimits& limits, bool whole = true)
      : hull_(limits.hull, limits.hull_margin_m), clearance_m_(limits.clearance_m), whole_(whole) {}

  // From `from_s` (on the piece) on; the piece begins at `start_s` of the obstacles' clock.
  // `bow(t)` gives the unit vector ahead and is asked near obstacles only; it turns by
  // `turning_radps` at most.
  template <typename Bow>
  [[nodiscard]] Walked along(const trajectory::Piece& piece, double from_s,
                             const Obstacles& obstacles, double start_s, double turning_radps,
                             const Bow& bow) const {
    const double approach =
        trajectory::speedBound(trajectory::differentiate<8>(piece.position), piece.duration_s) +
        (whole_ ? hull_.arm() * turning_radps : 0.0) + obstacles.rateBound();
    Walked walked;
    walked.least_m = std::numeric_limits<double>::infinity();
    const auto slackAt = [&](double t) {
      const double left = slack(
          obstacles, trajectory::evaluate<8>(piece.position, t), start_s + t,
          [&] { return bow(t); }, walked.centre_m);
      walked.least_m = std::min(walked.least_m, walked.centre_m);
      return left;
    };
    walked.conflict_s = firstConflict(from_s, piece.duration_s, approach, slackAt);
    return walked;
  }

 private:
  template <typename Bow>
  [[nodiscard]] double slack(const Obstacles& obstacles, const Eigen::Vector2d& position,
                             double time_s, const Bow& bow, double& centre_m) const {
    if (whole_) {
      return hull_.slack(obstacles, position, time_s, clearance_m_, bow, centre_m);
    }
    centre_m = obstacles.clearance(position, time_s);
    return centre_m - clearance_m_;
  }

  HullCover hull_;
  double clearance_m_;
  bool whole_;
};

}  // namespace otter_nav::feasibility
