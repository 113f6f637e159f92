// The chart's colours, after those of nautical charts: land is buff, and the better water is known
// the lighter it is.
#pragma once

#include <QColor>
#include <array>

#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::rviz_plugins {

enum class Water { kLand, kUnknown, kCharted, kSeen, kSensed, kGone };

struct PaletteEntry {
  Water water;
  QRgb colour;
  const char* name;
};
inline constexpr std::array<PaletteEntry, 6> kPalette = {{
    {Water::kLand, 0xffd8c48aU, "land"},
    {Water::kUnknown, 0xff6f8799U, "unknown"},
    {Water::kCharted, 0xffa9cbe0U, "charted water, unseen"},
    {Water::kSeen, 0xffe6f3f8U, "seen free"},
    {Water::kSensed, 0xffd0342cU, "sensed obstacle"},
    {Water::kGone, 0xffcdbfdaU, "land seen free"},
}};

[[nodiscard]] constexpr QRgb colourOf(Water water) {
  return kPalette[static_cast<std::size_t>(water)].colour;
}

// `chart` is what was known before, `map` what is believed now, `seen` whether a beam has crossed
// the cell.
[[nodiscard]] constexpr Water waterOf(map::Cell chart, map::Cell map, bool seen) {
  if (map == map::Cell::kOccupied) {
    return chart == map::Cell::kOccupied ? Water::kLand : Water::kSensed;
  }
  if (map == map::Cell::kUnknown) {
    return seen ? Water::kSeen : Water::kUnknown;
  }
  if (chart == map::Cell::kOccupied) {
    return Water::kGone;
  }
  // What the chart does not know and the map calls free was seen by somebody.
  return seen || chart == map::Cell::kUnknown ? Water::kSeen : Water::kCharted;
}

}  // namespace otter_nav::rviz_plugins
