#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace otter_nav {

// The value below which `share` (0 to 1) of the values lie (nearest rank); 0 of none.
template <typename Number>
[[nodiscard]] double quantile(std::vector<Number> values, double share) {
  if (values.empty()) {
    return 0.0;
  }
  const auto count = static_cast<double>(values.size());
  const double rank = std::clamp(std::ceil(share * count), 1.0, count);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(values.begin(), nth, values.end());
  return static_cast<double>(*nth);
}

}  // namespace otter_nav
