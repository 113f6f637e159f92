// From a polyline to a first spline: an elastic band for the shape, a forward and backward pass
// for the speed, knots at even times.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "optimizer/objective/spline_problem.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/vessel/flatness.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

struct WayOptions {
  double piece_length_m = 6.0;
  double force_share = 0.85;  // of both thrusters together, for the first guess of the speed
  double speed_max_mps = 4.6;
  double turn_radius_m = 2.5;  // of turns at speed next to the ends
  double clearance_m = 1.0;    // by DistanceField::smooth
};

// Where the way begins and ends, under way. The directions count where there is little speed.
struct WayEnds {
  vessel::FlatPoint start;
  vessel::FlatPoint goal;
  Eigen::Vector2d leave = Eigen::Vector2d::UnitX();
  Eigen::Vector2d arrive = Eigen::Vector2d::UnitX();
};

// The point `distance_m` along a polyline, from its start or, negative, from its end.
[[nodiscard]] Eigen::Vector2d pointAlong(const std::vector<Eigen::Vector2d>& polyline,
                                         double distance_m);

// Not thread-safe: keeps its workspace.
class InitialWay {
 public:
  InitialWay(const WayOptions& options, const vessel::Parameters& vessel)
      : options_(options), vessel_(vessel) {}

  WayOptions& options() { return options_; }

  // Fills `spline` (knots, all free but the first and the last, and durations).
  void build(const map::DistanceField& field, const std::vector<Eigen::Vector2d>& polyline,
             const WayEnds& ends, Spline& spline);

 private:
  void stretchBand(const map::DistanceField& field, const std::vector<Eigen::Vector2d>& polyline,
                   const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  void paceBand(double speed_from, double speed_to);
  [[nodiscard]] double speedIn(double curvature_per_m) const;
  [[nodiscard]] Knot knotAt(double s) const;
  void cutTime(double part_s);
  void appendArc(const Eigen::Vector2d& from, const Eigen::Vector2d& direction,
                 const Eigen::Vector2d& towards, std::vector<Eigen::Vector2d>& points) const;
  void turnAtEnds(const std::vector<Eigen::Vector2d>& polyline, const Eigen::Vector2d& from,
                  const Eigen::Vector2d& to, const WayEnds& ends);

  WayOptions options_;
  vessel::Parameters vessel_;
  double spacing_m_ = 1.0;
  std::vector<Eigen::Vector2d> band_;
  std::vector<Eigen::Vector2d> next_;
  std::vector<Eigen::Vector2d> tangent_;
  std::vector<double> curvature_;
  std::vector<double> speed_;
  std::vector<double> time_;
  std::vector<double> cuts_;
  std::vector<double> times_;  // of the cuts
  std::vector<Eigen::Vector2d> turned_;
  std::size_t held_head_ = 0;  // points of the band on arcs, not stretched
  std::size_t held_tail_ = 0;
};

}  // namespace otter_nav::optimizer
