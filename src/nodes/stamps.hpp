// Stamps that can't be true, on a clock that may be set back.
#pragma once

#include <ros/time.h>

namespace otter_nav::nodes {

// What else differs between clocks, or a simulated one that comes a little later than what it
// stamps, stays well below.
constexpr double kAheadMostS = 0.5;
constexpr char kStampedAhead[] = "its stamp is ahead of the clock";
constexpr char kStampedBack[] = "its stamp goes backwards";

// Negative when it is ahead. A ros::Duration would throw beyond 68 years, and a stamp may be
// anything.
[[nodiscard]] inline double age(const ros::Time& stamp, const ros::Time& now) {
  return now.toSec() - stamp.toSec();
}
// Nothing is, before a simulated clock has come up.
[[nodiscard]] inline bool isAhead(const ros::Time& stamp, const ros::Time& now) {
  return !now.isZero() && age(stamp, now) < -kAheadMostS;
}

// Why a message can't follow the one stamped `last`; null if it can. `last` is forgotten where the
// clock was set back. A `now` of zero: there is no clock but the stamps.
[[nodiscard]] inline const char* outOfOrder(const ros::Time& stamp, ros::Time& last,
                                            const ros::Time& now) {
  if (isAhead(stamp, now)) {
    return kStampedAhead;
  }
  if (isAhead(last, now)) {
    last = ros::Time();
  }
  return stamp < last ? kStampedBack : nullptr;
}

}  // namespace otter_nav::nodes
