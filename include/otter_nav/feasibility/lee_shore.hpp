// Lee shores: what lies where wind and current would set a hull that lost its heading. Nothing may,
// as far as that takes it until it lies into what pushes (docs/weather.md). To windward it says
// nothing.
//
// Near a trajectory's ends only as much is asked for as these have themselves, and more and more
// away from them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "otter_nav/feasibility/obstacles.hpp"

namespace otter_nav::feasibility {

class LeeShore final : public ObstacleLayer {
 public:
  // Set aside by up to `drift_m`, the hull's centre keeps `least_m` from what `field` holds (not
  // owned); a trajectory that keeps `clearance_m` from this layer does.
  LeeShore(const map::DistanceField& field, const Eigen::Vector2d& drift_m, double least_m,
           double clearance_m, const Eigen::Vector2d& start, const Eigen::Vector2d& goal)
      : field_(&field),
        drift_m_(drift_m),
        slack_m_(std::max(0.0, clearance_m - least_m)),
        clearance_m_(clearance_m),
        ends_{End{start, freeShare(start)}, End{goal, freeShare(goal)}} {}

  [[nodiscard]] double clearance(const Eigen::Vector2d& position,
                                 double /*time_s*/) const override {
    const double share = shareAt(position);
    double least = field_->maxDistance() + slack_m_;
    for (const double part : kParts) {
      least = std::min(least, field_->clearance(position + part * share * drift_m_) + slack_m_);
    }
    return scaled(least);
  }
  [[nodiscard]] double rateBound() const override { return 0.0; }
  [[nodiscard]] map::DistanceField::Smooth smooth(const Eigen::Vector2d& position,
                                                  double /*time_s*/) const override {
    const double share = shareAt(position);
    map::DistanceField::Smooth nearest{field_->maxDistance() + slack_m_, Eigen::Vector2d::Zero()};
    for (const double part : kParts) {
      map::DistanceField::Smooth at = field_->smooth(position + part * share * drift_m_);
      at.distance_m += slack_m_;
      nearest = at.distance_m < nearest.distance_m ? at : nearest;
    }
    return nearest;
  }

 private:
  struct End {
    Eigen::Vector2d position;
    double share;
  };
  static constexpr std::array<double, 3> kParts = {1.0 / 3.0, 2.0 / 3.0, 1.0};
  static constexpr double kGrowth = 0.5;  // of the drift asked for, m in a metre from an end

  // The drift grows with the way from an end: what it reaches moves faster than the position.
  [[nodiscard]] double scaled(double distance_m) const {
    return clearance_m_ + (distance_m - clearance_m_) / (1.0 + kGrowth);
  }
  [[nodiscard]] double shareAt(const Eigen::Vector2d& position) const {
    double share = 1.0;
    for (const End& end : ends_) {
      share = std::min(share, end.share + kGrowth * (position - end.position).norm() /
                                              std::max(drift_m_.norm(), 1e-9));
    }
    return share;
  }
  // Of the drift, that there is room for.
  [[nodiscard]] double freeShare(const Eigen::Vector2d& position) const {
    constexpr int kSteps = 10;
    constexpr double kMarginM = 0.1;
    for (int k = 1; k <= kSteps; ++k) {
      const double share = static_cast<double>(k) / kSteps;
      if (field_->clearance(position + share * drift_m_) + slack_m_ < clearance_m_ + kMarginM) {
        return static_cast<double>(k - 1) / kSteps;
      }
    }
    return 1.0;
  }

  const map::DistanceField* field_;
  Eigen::Vector2d drift_m_;
  double slack_m_;
  double clearance_m_;
  std::array<End, 2> ends_;
};

}  // namespace otter_nav::feasibility
