// What the vessel knows of the water: the lidar's scans in the occupancy map, the distance field
// that follows it, and the tracks of other vessels.
#pragma once

#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/map/occupancy_map.hpp"
#include "otter_nav/plant/signals.hpp"
#include "otter_nav/simulation/closed_loop.hpp"
#include "otter_nav/traffic/tracker.hpp"

namespace otter_nav::simulation {

class Sensing {
 public:
  Sensing(map::OccupancyGrid chart, const LoopOptions& options);

  // Where the odometry says the vessel was, the scan is put into the map. A scan from over the
  // map's edge is left out.
  [[nodiscard]] Status insert(Scan scan, const plant::Odometry& odometry);
  void hear(const std::vector<Eigen::Vector2d>& radar_in_base, const plant::Odometry& odometry);
  [[nodiscard]] Status hear(double stamp_s, const std::vector<std::string>& ais);

  [[nodiscard]] const map::DistanceField& field() const { return field_; }
  // Of other vessels: confirmed ones, each at the instant it was last measured.
  [[nodiscard]] const std::vector<traffic::Track>& tracks() const { return traffic_.tracks(); }
  // With what nobody has seen to be free as obstacles for stops.
  [[nodiscard]] feasibility::Obstacles obstacles() const {
    feasibility::Obstacles obstacles(field_);
    obstacles.setKnownWater(known_);
    return obstacles;
  }

 private:
  map::OccupancyMap map_;
  map::DistanceField field_;
  map::DistanceField known_;
  traffic::Tracker traffic_;
  Eigen::Vector3d lidar_in_base_;

  void update(const map::CellRectangle& changed);
};

}  // namespace otter_nav::simulation
