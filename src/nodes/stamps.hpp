// Stamps that can't be true, on a clock that may be set back.
#pragma once

#include <ros/time.h>

namespace otter_nav::nodes {

// What else differs between clocks, or a simulated one that comes a little later than what it
// stamps, stays well below.
constexpr double kAheadMostS = 0.5;
constexpr char kStampedAhead[] = "its stamp is ahead of the clock";

// Negative when it is ahead. A ros::Duration would throw beyond 68 years, and a stamp may be
// anything.
[[nodiscard]] inline double age(const ros::Time& stamp, const ros::Time& now) {
  return now.toSec() - stamp.toSec();
}
// Nothing is, before a simulated clock has come up.
[[nodiscard]] inline bool isAhead(const ros::Time& stamp, const ros::Time& now) {
  return !now.isZero() && age(stamp, now) < -kAheadMostS;
}

}  // namespace otter_nav::nodes
