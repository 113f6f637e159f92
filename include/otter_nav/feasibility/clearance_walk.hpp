// The one walk along a path that asks for clearance: nothing is stepped over, however thin.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

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

}  // namespace otter_nav::feasibility
