// The colour of a speed, for lines on a light chart: from dark blue at rest over magenta to orange
// at full speed, lighter all the way, so that it can be told without seeing colours.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace otter_nav::ros_bridge {

// Red, green, blue in [0, 1]; `share` of the top speed.
[[nodiscard]] inline std::array<double, 3> speedColour(double share) {
  constexpr std::array<std::array<double, 3>, 4> kStops = {
      {{0.05, 0.03, 0.53}, {0.50, 0.01, 0.66}, {0.80, 0.28, 0.47}, {0.98, 0.60, 0.22}}};
  const double place = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), kStops.size() - 2);
  const double part = place - static_cast<double>(low);
  std::array<double, 3> colour{};
  for (std::size_t k = 0; k < colour.size(); ++k) {
    colour[k] = (1.0 - part) * kStops[low][k] + part * kStops[low + 1][k];
  }
  return colour;
}

}  // namespace otter_nav::ros_bridge
