// The last resort: straight from point to point of a clear polyline, stopping at each to spin.
// Slow, but feasible wherever the polyline is clear.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "otter_nav/feasibility/safety_limits.hpp"
#include "otter_nav/map/distance_field.hpp"
#include "otter_nav/optimizer/spin.hpp"
#include "otter_nav/trajectory/boundary.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::optimizer {

class StopAndSpin {
 public:
  StopAndSpin(const vessel::Parameters& vessel, const SpinLimits& spin,
              const feasibility::SafetyLimits& safety)
      : vessel_(vessel), spin_(spin), safety_(safety) {}

  // From rest at `start` to rest at `goal`, headings included; the way's ends are replaced by
  // theirs.
  [[nodiscard]] trajectory::Trajectory follow(const std::vector<Eigen::Vector2d>& path,
                                              const trajectory::Boundary& start,
                                              const trajectory::Boundary& goal) const;
  // Another way along `path` with straight and clear legs, from end to end in the least time: stops
  // are points of `path`, or a little farther from what is near. `path` where there is none.
  [[nodiscard]] std::vector<Eigen::Vector2d> quickestStops(const map::DistanceField& field,
                                                           const std::vector<Eigen::Vector2d>& path,
                                                           const trajectory::Boundary& start,
                                                           const trajectory::Boundary& goal) const;

 private:
  // Of a leg from rest to rest.
  [[nodiscard]] double legDuration(double length_m) const;
  void appendStraight(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                      std::vector<trajectory::Piece>& pieces) const;

  vessel::Parameters vessel_;
  SpinLimits spin_;
  feasibility::SafetyLimits safety_;
};

}  // namespace otter_nav::optimizer
