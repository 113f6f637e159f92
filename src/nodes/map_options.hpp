// Parameters that nodes with a map share.
#pragma once

#include "otter_nav/config/section.hpp"
#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::nodes {

inline Result<map::DistanceFieldOptions> readDistanceFieldOptions(config::Section section) {
  map::DistanceFieldOptions options;
  section.read("max_distance_m", options.max_distance_m, {1.0, 100.0});
  section.read("unknown_is_occupied", options.unknown_is_occupied);
  return section.finish().map([&] { return options; });
}

}  // namespace otter_nav::nodes
