// A lidar that turns in the hull's deck plane and so tilts with roll and pitch.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "otter_nav/base/random.hpp"
#include "otter_nav/base/scan.hpp"
#include "otter_nav/plant/options.hpp"
#include "otter_nav/plant/other_vessels.hpp"
#include "otter_nav/plant/signals.hpp"
#include "otter_nav/plant/world_map.hpp"

namespace otter_nav::plant {

class Lidar {
 public:
  Lidar(const LidarOptions& options, std::uint64_t seed);

  // Obstacles and other vessels are upright walls from the water up. A beam that meets the mean
  // water surface first returns nothing: water swallows it.
  const Scan& scan(const WorldMap& world, const OtherVessels& others, const Truth& truth);

  [[nodiscard]] double rangeMax() const { return options_.range_max_m; }

 private:
  // A noiseless return turned into what the instrument reports.
  [[nodiscard]] float report(double range_m);

  LidarOptions options_;
  Random random_;
  std::vector<Eigen::Vector2d> beams_;  // directions in the lidar's plane
  Scan scan_;
};

}  // namespace otter_nav::plant
