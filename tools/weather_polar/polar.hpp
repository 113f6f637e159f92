// What speed a vessel can hold on which course in which wind (or under which force), and on which
// heading.
#pragma once

#include <string>
#include <vector>

#include "otter_nav/base/result.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::tools {

struct PolarOptions {
  std::vector<double> winds_mps;
  std::vector<double> forces_n;  // fixed in the earth frame, for vessels without wind loads
  double gust = 0.0;         // the wind (force) that must be held besides, over the mean, less 1
  double current_mps = 0.0;  // along the wind; negative: against it
  double reserve = 0.05;     // of the thrusters' limits
  int courses = 72;
  double speed_step_mps = 0.05;
};

// One course and speed over ground. Angles count from where the wind comes from: 0 is dead against
// it.
struct PolarPoint {
  double wind_mps = 0.0;
  double force_n = 0.0;
  double course_rad = 0.0;
  double speed_mps = 0.0;
  bool held = false;
  double heading_rad = 0.0;   // of the least thrust, in [-pi, pi]
  double thrust_share = 0.0;  // of the limits, in the gust; infinite where there is no heading
};

// Speeds from zero to the vessel's top speed in `speed_step_mps`, for each course and each wind (or
// force). Error: a wind for a vessel whose file has no wind loads.
[[nodiscard]] Result<std::vector<PolarPoint>> polar(const vessel::Parameters& vessel,
                                                    const PolarOptions& options);

// Columns: wind_mps, force_n, course_rad, speed_mps, held, heading_rad, thrust_share.
[[nodiscard]] Status savePolarCsv(const std::string& path, const std::vector<PolarPoint>& points);
// A rose for each wind or force: on each course the speeds that are held, darker the more thrust
// they take. Up is against the wind.
[[nodiscard]] Status savePolarSvg(const std::string& path, const std::string& title,
                                  const std::vector<PolarPoint>& points, double speed_step_mps);

}  // namespace otter_nav::tools
