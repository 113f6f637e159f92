// Keeps a small hull upright in a steep sea: thrust acts below the centre of gravity, so what is
// pushed ahead lifts the bow, and astern presses it down. Where it goes too far less is pushed that
// way, at last the other.
#pragma once

#include "otter_nav/vessel/thrusters.hpp"

namespace otter_nav::tracker {

class BowGuard {
 public:
  // At each odometry; what isn't finite is taken as level.
  void add(double stamp_s, double bow_up_rad);
  // As level as at first: what was seen long ago says nothing.
  void forget() { *this = {}; }
  // What the thrusters push together is cut down, what they turn the hull with is kept.
  [[nodiscard]] vessel::Thrusts cut(const vessel::Thrusts& wanted,
                                    const vessel::Thrusters& thrusters) const;

 private:
  double stamp_s_ = 0.0;
  double bow_up_rad_ = 0.0;
  double rate_radps_ = 0.0;
};

}  // namespace otter_nav::tracker
