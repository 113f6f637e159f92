// A scan's echoes, without what the chart shows and the own hull, gathered into things.
#pragma once

#include <vector>

#include "otter_nav/base/scan.hpp"
#include "otter_nav/map/occupancy_map.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "outline_fit.hpp"
#include "scan_memory.hpp"

namespace otter_nav::traffic {

class ScanClusters {
 public:
  struct Echo {
    std::size_t beam = 0;
    Eigen::Vector2d point;
    double range_m = 0.0;  // over ground
    bool is_new = false;
    bool stands = false;
  };
  ScanClusters(const map::OccupancyGrid& chart, const vessel::Hull& own_hull);

  // In the order of the beams. The reference stays valid until the next scan.
  const std::vector<Cluster>& gather(double stamp_s, const map::SensorPose& sensor,
                                     const vessel::Pose& own, const Scan& scan);
  // All that the scan gathered last has met, but for charted land and the own hull.
  [[nodiscard]] const std::vector<Echo>& echoes() const { return echoes_; }
  // Next to the water: waves, or a hull's foot. They make no thing, but a map may take them.
  [[nodiscard]] const std::vector<Echo>& lowEchoes() const { return low_; }
  // How much of something at `position` could be seen in the scan gathered last: all of it (1), a
  // part (0.5: its far end is out of range, or where the waves hide it), or nothing (0: all of it
  // is, or behind something nearer). What is met up to `near_m` before it is the thing itself;
  // `doubt_m` more if it hasn't stood there for a while.
  [[nodiscard]] double inSight(const Eigen::Vector2d& position, double near_m, double doubt_m,
                               double beam_m) const;

 private:
  [[nodiscard]] bool isCharted(const Eigen::Vector2d& point) const;
  void readEchoes(const map::SensorPose& sensor, const vessel::Pose& own, const Scan& scan);
  void remember();
  void divide(std::size_t beams, double increment_rad);
  void findCuts(Cluster& cluster) const;

  map::GridGeometry geometry_;
  std::vector<bool> charted_;  // land, and the cells next to it
  vessel::Hull own_hull_;
  ScanMemory memory_;
  std::vector<Echo> echoes_;  // uncharted ones
  std::vector<Echo> low_;
  std::vector<Eigen::Vector2d> others_;  // the charted ones
  std::vector<Cluster> clusters_;
  // Of each beam, over ground: direction, how far it saw nothing (NaN: it says nothing), and how
  // far it would have seen, to the lidar's range or the water.
  std::vector<Eigen::Vector2d> directions_;
  std::vector<double> free_m_;
  std::vector<double> reach_m_;
  std::vector<bool> ends_at_standing_;
  Eigen::Vector2d eye_ = Eigen::Vector2d::Zero();
  // A level direction to the lidar's plane, straight up or down.
  Eigen::Matrix2d sensor_from_level_ = Eigen::Matrix2d::Identity();
  double angle_min_rad_ = 0.0;
  double increment_rad_ = 1.0;
  double range_max_m_ = 0.0;
};

}  // namespace otter_nav::traffic
