// What is known of the water: the chart, and what the lidar has seen on top of it, held in an
// OctoMap; its projection to the plane is kept up to date scan by scan.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "otter_nav/base/attitude.hpp"
#include "otter_nav/base/result.hpp"
#include "otter_nav/base/scan.hpp"
#include "otter_nav/config/fields.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/map/occupancy_grid.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/pose.hpp"

namespace otter_nav::map {

struct OccupancyMapOptions {
  HeightBand band;
  double hit_probability = 0.85;
  double miss_probability = 0.4;
  double occupied_probability = 0.7;
  double hull_margin_m = 0.2;
  bool trust_chart = true;

  template <typename Self, typename Fields>
  static void describe(Self& o, Fields& fields) {
    fields("band_min_m", o.band.min_m, {-10.0, 100.0}, "heights over the water that matter:");
    fields("band_max_m", o.band.max_m, {-10.0, 100.0}, "below are waves, above is sky");
    fields("hit_probability", o.hit_probability, {0.55, 0.99},
           "of a voxel being occupied, seen one echo");
    fields("miss_probability", o.miss_probability, {0.01, 0.5}, "the same, seen one beam pass");
    fields("occupied_probability", o.occupied_probability, {0.5, kMaxProbability},
           "from here on a voxel counts as an obstacle");
    fields("hull_margin_m", o.hull_margin_m, {0.0, 10.0},
           "echoes this close to the own hull are its own");
    fields("trust_chart", o.trust_chart,
           "water that the chart shows free is known to be so; else only once it was seen");
  }
  // Beliefs are clamped, so that what moved away clears in time.
  static constexpr double kMinProbability = 0.12;
  static constexpr double kMaxProbability = 0.97;
};
[[nodiscard]] Result<OccupancyMapOptions> readOccupancyMapOptions(config::Section section);
[[nodiscard]] Result<OccupancyMapOptions> loadOccupancyMapOptions(const std::string& path);

// The sensor in the map frame (ENU, FLU); z over the mean water surface.
struct SensorPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;

  [[nodiscard]] Eigen::Matrix3d rotation() const {
    return attitude(roll_rad, pitch_rad, yaw_rad).toRotationMatrix();
  }
};

class OccupancyMap {
 public:
  // The chart's obstacles stand from the sea up: no beam ever clears them. Unless the chart is
  // trusted, its free water is unknown to the projection until it was seen.
  OccupancyMap(OccupancyGrid chart, const vessel::Hull& own_hull,
               const OccupancyMapOptions& options);
  ~OccupancyMap();
  OccupancyMap(OccupancyMap&&) noexcept;
  OccupancyMap& operator=(OccupancyMap&&) noexcept;

  // The cells whose projection changed, or why the scan is refused (a pose or angle that is no
  // number, no beams, limits that make no sense, a negative range): then nothing changes. Echoes
  // within the own hull's outline and its margin are dropped, and what was sensed there is cleared;
  // `own` is where its middle (base_link) is while the sensor looks.
  [[nodiscard]] Result<CellRectangle> insertScan(const SensorPose& sensor, const vessel::Pose& own,
                                                 const Scan& scan);

  [[nodiscard]] const OccupancyGrid& projection() const;
  [[nodiscard]] const OccupancyGrid& chart() const;
  // Clears what was sensed in the columns of these points: what was met there has moved on. The
  // changed cells.
  CellRectangle forget(const std::vector<Eigen::Vector2d>& points);
  // Takes these points, at heights over the water, for occupied as if an echo had met each: what is
  // known to be there though the lidar sees but its near sides. Beams that pass there clear it. The
  // changed cells.
  CellRectangle fill(const std::vector<Eigen::Vector3d>& points);
  // Forgets what was sensed; the changed cells.
  CellRectangle reset();
  // By the path's ending: .bt or .ot (the tree), .yaml (the projection, with a PGM beside it). A
  // tree reaches 32768 cells to each side of the map's origin: what lies beyond, in UTM coordinates
  // for instance, can be saved as .yaml only.
  [[nodiscard]] Status save(const std::string& path) const;

 private:
  struct Sensed;
  std::unique_ptr<Sensed> sensed_;
};

}  // namespace otter_nav::map
