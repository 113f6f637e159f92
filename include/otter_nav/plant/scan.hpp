// One turn of the lidar, as sensor_msgs/LaserScan wants it.
#pragma once

#include <vector>

namespace otter_nav::plant {

// ranges[i] is the beam at angle_min_rad + i * angle_increment_rad in the lidar's own plane. Values
// after REP-117: +inf no return (or the water's surface came first), -inf too close, NaN a lost
// measurement.
struct Scan {
  double stamp_s = 0.0;
  double angle_min_rad = 0.0;
  double angle_increment_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges;
};

}  // namespace otter_nav::plant
