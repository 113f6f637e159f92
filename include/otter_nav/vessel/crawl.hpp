// The crawl: a pace at which a hull without side thrusters can't make good what waves from abeam
// set it aside by; it could only turn against them, always late. The tracker leaves them alone
// there, and plans go no faster where there is no room for more.
#pragma once

#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::vessel {

constexpr double kCrawlPerS = 0.4;  // hull's lengths a second

[[nodiscard]] inline double crawlMps(const Hull& hull) {
  return kCrawlPerS * hull.length_m;
}

}  // namespace otter_nav::vessel
