// What the vessel knows of the water: the lidar's scans in the occupancy map, and the distance
// field that follows it.
#pragma once

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/map/occupancy_map.hpp"
#include "otter_nav/plant/signals.hpp"
#include "otter_nav/simulation/closed_loop.hpp"

namespace otter_nav::simulation {

class Sensing {
 public:
  Sensing(map::OccupancyGrid chart, const LoopOptions& options);

  // Where the odometry says the vessel was, the scan is put into the map. A scan from over the
  // map's edge is left out.
  [[nodiscard]] Status insert(const plant::Scan& scan, const plant::Odometry& odometry);

  [[nodiscard]] const map::DistanceField& field() const { return field_; }

 private:
  map::OccupancyMap map_;
  map::DistanceField field_;
  Eigen::Vector3d lidar_in_base_;
  map::Scan scan_;
};

}  // namespace otter_nav::simulation
