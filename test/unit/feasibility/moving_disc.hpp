// An obstacle that moves, for tests of whoever asks where it is when.
#pragma once

#include <algorithm>
#include <utility>

#include "otter_nav/feasibility/obstacles.hpp"

namespace otter_nav::feasibility::test {

// A disc that moves on a line.
class MovingDisc : public ObstacleLayer {
 public:
  MovingDisc(Eigen::Vector2d at, Eigen::Vector2d velocity, double radius_m)
      : at_(std::move(at)), velocity_(std::move(velocity)), radius_m_(radius_m) {}
  [[nodiscard]] double clearance(const Eigen::Vector2d& p, double time_s) const override {
    return std::max(0.0, (p - at_ - time_s * velocity_).norm() - radius_m_);
  }
  [[nodiscard]] double rateBound() const override { return velocity_.norm(); }
  [[nodiscard]] map::DistanceField::Smooth smooth(const Eigen::Vector2d& p,
                                                  double time_s) const override {
    const Eigen::Vector2d off = p - at_ - time_s * velocity_;
    return {off.norm() - radius_m_, off.normalized()};
  }

 private:
  Eigen::Vector2d at_, velocity_;
  double radius_m_;
};

}  // namespace otter_nav::feasibility::test
