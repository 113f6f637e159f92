// Positions over time from a CSV, and their derivatives by local polynomial fits.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::benchmark {

struct TimedPoint {
  double t_s;
  Eigen::Vector2d position;
};

// Columns t (s, growing), x and y (m) by name in the first line, others ignored; at least 20 rows.
// Errors name the file, the row and what is wrong.
[[nodiscard]] Result<std::vector<TimedPoint>> readTimedPoints(const std::string& path);

// Position, velocity, acceleration and jerk at `t_s`: a least-squares polynomial of degree 5 over
// the nearest points within 0.3 s (at least ten).
[[nodiscard]] vessel::FlatPoint fitAt(const std::vector<TimedPoint>& points, double t_s);

}  // namespace otter_nav::benchmark
