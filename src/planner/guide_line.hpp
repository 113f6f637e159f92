// The guide path as the sampler sees it: pushed out to a safe distance, its corners rounded,
// measured by its length, with a direction, a speed the vessel could have there and the half width
// of the corridor around it (paper, section IV-A).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/trajectory/polynomial/path_line.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::planner {

struct GuideLineOptions {
  double spacing_m = 1.0;         // of the points the line is held at
  double speed_mps = 0.0;         // at most
  double speed_start_mps = 0.0;   // at the line's first point
  double force_ahead_n = 0.0;     // surge force at most
  double corridor_m = 6.0;        // half width at most
  double half_width_min_m = 0.5;  // and at least
  double ramp_share = 0.6;        // of the thrust free at a speed is used to speed up or slow down
  double safe_distance_m = 1.5;   // the line is pushed out to this where there is room
  int relaxations = 30;           // rounds of rounding the line's corners
};

class GuideLine {
 public:
  struct Point : trajectory::PathLine::Point {
    double half_width_m = 0.0;
  };

  // `points` from start to goal, at least two. Keeps its memory from call to call.
  void build(const std::vector<Eigen::Vector2d>& points, const map::DistanceField& field,
             const vessel::Parameters& vessel, const GuideLineOptions& options);

  // After rounding; the given points' length differs a little.
  [[nodiscard]] double length() const { return line_.length(); }
  // Linear between the held points; `s_m` is clamped to the line.
  [[nodiscard]] Point at(double s_m) const;

 private:
  trajectory::PathLine line_;
  std::vector<double> half_width_m_;
};

}  // namespace otter_nav::planner
