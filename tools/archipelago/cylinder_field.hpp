// Seeded narrow worlds that no chart shows: a basin within a border of land, with a field of thin
// cylinders in its middle and one mission through it, from end to end.
#pragma once

#include <cstdint>

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/map/occupancy_grid.hpp"
#include "otter_nav/scenario/scenario.hpp"

namespace otter_nav::scenario {

struct CylinderFieldOptions {
  double width_m = 13.0;   // of the field
  double length_m = 20.0;  // along the mission
  double end_m = 5.0;      // of free water before the field and behind it
  double border_m = 2.0;   // of land around the basin
  double resolution_m = 0.1;
  double radius_m = 0.22;  // of a cylinder
  int fewest = 200;
  int most = 370;
  // What the best way through leaves the hull's centre, m.
  double best_min_m = 0.65;
  double best_max_m = 0.9;
};

struct CylinderField {
  map::OccupancyGrid chart;  // unknown all over: it shows not even the border
  map::OccupancyGrid world;
  Mission mission;
  double best_m = 0.0;  // the clearance of the best way, by widestWay()
  int cylinders = 0;
};

// The same for the same seed on every machine. Clumps from a cellular automaton, less what stands
// in a wandering way, are drawn until number and best way (measured, for there may be better ones)
// are within the options' ranges; an error if they never are.
[[nodiscard]] Result<CylinderField> generateCylinderField(const CylinderFieldOptions& options,
                                                          std::uint64_t seed);

// The clearance of the way between two places, over centres of neighbouring cells, that keeps
// furthest from everything; 0 if there is none. Between two centres a straight line keeps at least
// as much less 0.71 cells.
[[nodiscard]] double widestWay(const map::DistanceField& field, const Eigen::Vector2d& from,
                               const Eigen::Vector2d& to);

}  // namespace otter_nav::scenario
