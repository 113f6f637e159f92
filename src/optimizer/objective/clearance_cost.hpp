// lc max(0, clearance wanted - distance)^2 (the paper's f_c), of the hull's centre and of two
// circles ahead and astern of it, at the time the spline is there; and the same of each for room
// that is preferred, cheaper.
#pragma once

#include <algorithm>

#include "optimizer/objective/cost.hpp"

namespace otter_nav::optimizer {

class ClearanceCost final : public Cost {
 public:
  void add(const Targets& targets, Point& point) const override {
    if (point.piece.obstacles == nullptr) {
      return;
    }
    const SplineLimits& limits = targets.limits;
    const bool hull = limits.hull_offset_m > 0.0;
    // Position first, the rest only near obstacles.
    const Eigen::Vector2d p = point.position();
    const map::DistanceField::Smooth centre = point.piece.obstacles->smooth(p, point.time_s);
    if (centre.distance_m > limits.reach_m()) {
      return;
    }
    const Rows& z = point.path();
    point.addHinge(targets.weights.room, limits.room_m - centre.distance_m, kKneeM, 0,
                   [&]() -> Eigen::Vector2d { return -centre.gradient; });
    point.addHinge(targets.weights.clearance, limits.clearance_m - centre.distance_m, kKneeM, 0,
                   [&]() -> Eigen::Vector2d { return -centre.gradient; });
    if (!hull || centre.distance_m > limits.near_m()) {
      return;
    }
    const Eigen::Vector2d w = point.dynamics.headingForce(z.col(1), z.col(2));
    addEnds(targets, point, point.dynamics.bow(w, w, point.force_floor_n), limits.hull_clearance_m);
    if (targets.leaning != nullptr) {
      const Eigen::Vector2d leans = targets.leaning->headingForce(z.col(1), z.col(2));
      addEnds(targets, point, targets.leaning->bow(leans, leans, point.force_floor_n),
              limits.leaning_clearance_m);
    }
  }

 private:
  static void addEnds(const Targets& targets, Point& point, const vessel::Bow& bow,
                      double clearance_m) {
    const double offset_m = targets.limits.hull_offset_m;
    for (const double offset : {-offset_m, offset_m}) {
      const map::DistanceField::Smooth end =
          point.piece.obstacles->smooth(point.position() + offset * bow.ahead, point.time_s);
      const auto slope = [&] {
        Rows rows;
        rows.col(0) = -end.gradient;
        rows.rightCols<4>() = -offset * point.dynamics.byPath(vessel::InverseDynamics::bowGradient(
                                            bow, end.gradient));
        return rows;
      };
      point.addHinge(targets.weights.hull_room, targets.limits.hull_room_m - end.distance_m, kKneeM,
                     slope);
      point.addHinge(targets.weights.clearance, clearance_m - end.distance_m, kKneeM, slope);
    }
  }

  static constexpr double kKneeM = 1.0;
};

}  // namespace otter_nav::optimizer
