// Stamps that can't be true, on a clock that may be set back.
#pragma once

#include <ros/time.h>

namespace otter_nav::nodes {

// What else differs between clocks, or a simulated one that comes a little later than what it
// stamps, stays well below.
constexpr double kAheadMostS = 0.5;
constexpr char kStampedAhead[] = "its stamp is ahead of the clock";

// Nothing is, before a simulated clock has come up.
[[nodiscard]] inline bool isAhead(const ros::Time& stamp, const ros::Time& now) {
  return !now.isZero() && (stamp - now).toSec() > kAheadMostS;
}

}  // namespace otter_nav::nodes
