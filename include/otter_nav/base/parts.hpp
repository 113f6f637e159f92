// A whole cut into equal parts.
#pragma once

#include <algorithm>
#include <cmath>

namespace otter_nav {

// How many parts, none longer than `longest`, `least` or more.
[[nodiscard]] inline int partsOf(double whole, double longest, int least = 1) {
  return std::max(least, static_cast<int>(std::ceil(whole / longest)));
}

}  // namespace otter_nav
