// What is known of the water: the chart, and what the lidar has seen on top of it, held in an
// OctoMap; its projection to the plane is kept up to date scan by scan.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/config/section.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::map {

struct OccupancyMapOptions {
  HeightBand band;                    // hits outside it are ignored: below is water, above is sky
  double hit_probability = 0.85;      // of a voxel being occupied, seen one hit
  double miss_probability = 0.4;      // the same, seen one beam pass
  double occupied_probability = 0.7;  // from here on a voxel counts
  double min_probability = 0.12;      // beliefs are clamped, so that what moved away clears in time
  double max_probability = 0.97;
  double hull_length_m = 2.0;  // the vessel's own outline, grown by hull_margin_m: echoes of
  double hull_beam_m = 1.08;   // it are dropped, and what was sensed there before is cleared
  double hull_margin_m = 0.2;
  double sensor_ahead_m = 0.0;  // of the outline's centre
};
[[nodiscard]] Result<OccupancyMapOptions> readOccupancyMapOptions(config::Section section);

// The sensor in the map frame (ENU, FLU); z over the mean water surface, angles as yaw, then
// pitch, then roll.
struct SensorPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
};

// sensor_msgs/LaserScan's figures; REP-117: +inf is free water up to range_max, -inf (too close)
// and NaN (no measurement) say nothing.
struct Scan {
  double angle_min_rad = 0.0;
  double angle_increment_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;
};

// Changed cells, half open; empty if width or height is 0.
struct CellRectangle {
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;

  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
};

class OccupancyMap {
 public:
  // The chart's obstacles stand from the sea up: no beam ever clears them.
  OccupancyMap(OccupancyGrid chart, const OccupancyMapOptions& options);
  ~OccupancyMap();
  OccupancyMap(OccupancyMap&&) noexcept;
  OccupancyMap& operator=(OccupancyMap&&) noexcept;

  // The cells whose projection changed, or why the scan is refused (a pose or angle that is no
  // number, no beams, limits that make no sense, a negative range): then nothing changes.
  [[nodiscard]] Result<CellRectangle> insertScan(const SensorPose& sensor, const Scan& scan);

  [[nodiscard]] const OccupancyGrid& projection() const;
  [[nodiscard]] const OccupancyGrid& chart() const;
  // Forgets what was sensed; the changed cells.
  CellRectangle reset();
  // By the path's ending: .bt or .ot (the tree), .yaml (the projection, with a PGM beside it).
  [[nodiscard]] Status save(const std::string& path) const;

 private:
  struct Sensed;
  std::unique_ptr<Sensed> sensed_;
};

}  // namespace otter_nav::map
