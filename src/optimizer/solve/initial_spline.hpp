// From a polyline to a first spline: an elastic band for the shape, a forward and backward pass
// for the speed, knots at even times.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/objective/spline.hpp"
#include "otter_nav/feasibility/obstacles.hpp"
#include "otter_nav/trajectory/polynomial/path_line.hpp"
#include "otter_nav/vessel/parameters.hpp"
#include "otter_nav/vessel/types.hpp"

namespace otter_nav::optimizer {

struct InitialOptions {
  double piece_length_m = 6.0;
  double force_share = 0.85;  // of both thrusters together, for the first guess of the speed
  double speed_max_mps = 0.0;
  double clearance_m = 1.0;  // by Obstacles::smooth
  double load_n = 0.0;       // that wind and current take of the force, at worst
  double slowest_mps = 0.8;  // where it begins and ends at rest
  double start_s = 0.0;      // the spline's start, on the obstacles' clock
  double clock = 1.0;        // seconds of that for one of the spline
};

// Where the spline begins and ends, under way. The directions count where there is little speed.
struct SplineEnds {
  vessel::FlatPoint start;
  vessel::FlatPoint goal;
  Eigen::Vector2d leave = Eigen::Vector2d::UnitX();
  Eigen::Vector2d arrive = Eigen::Vector2d::UnitX();
};

// Not thread-safe: keeps its workspace.
class InitialSpline {
 public:
  explicit InitialSpline(const vessel::Parameters& vessel) : vessel_(vessel) {}

  InitialOptions options;

  // Fills `spline` (knots, all free but the first and the last, and durations). Obstacles count
  // where they are about when the vessel may get there.
  void build(const feasibility::Obstacles& obstacles, const std::vector<Eigen::Vector2d>& polyline,
             const SplineEnds& ends, Spline& spline);

 private:
  void turnAtEnds(const std::vector<Eigen::Vector2d>& polyline, const SplineEnds& ends);
  void setSpeeds(double speed_from, double speed_to);
  [[nodiscard]] double speedIn(double curvature_per_m) const;
  [[nodiscard]] Knot knotAt(double s) const;
  void cutTime(double part_s);

  vessel::Parameters vessel_;
  trajectory::PathLine line_;
  std::vector<double> time_;
  std::vector<double> cuts_;   // distances along the line
  std::vector<double> times_;  // of the cuts
  std::vector<Eigen::Vector2d> turned_;
  std::size_t held_head_ = 0;  // points of the line on arcs, not relaxed
  std::size_t held_tail_ = 0;
};

}  // namespace otter_nav::optimizer
