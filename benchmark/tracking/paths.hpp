// Trajectories of the tracking benchmark: a figure of eight, a widening spiral, and a file's.
#pragma once

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/trajectory/trajectory.hpp"

namespace otter_nav::benchmark {

// Eight and spiral go on this much longer than what is measured, so that no horizon sees an end.
constexpr double kRunOutS = 5.0;

// x = 50 sin(w t), y = 25 sin(2 w t) once round; w so that the fastest point has `top_speed_mps`.
[[nodiscard]] trajectory::Trajectory eight(double top_speed_mps);

// Radius 8 m to 60 m in three turns, speed rising from 0.6 of the top speed to all of it with the
// radius; continuous to the third derivative.
[[nodiscard]] trajectory::Trajectory spiral(double top_speed_mps);

// A CSV with columns t, x, y (others are ignored), at equal steps or not, at least 20 rows:
// smoothed into pieces of half a second.
[[nodiscard]] Result<trajectory::Trajectory> fromCsv(const std::string& path);

}  // namespace otter_nav::benchmark
