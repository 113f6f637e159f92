// How fast waves move the hull to the side of what is steered, means over as long as courses are.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "otter_nav/base/planar.hpp"

namespace otter_nav::encounter {

constexpr double kCourseS = 2.0;  // courses over ground are means over this

class Swing {
 public:
  // So far, m/s: what it often reaches. `off` is the hull's place from where it is steered.
  double seen(double now_s, const Eigen::Vector2d& off, const Eigen::Vector2d& steered_mps) {
    constexpr double kMemoryS = 30.0;
    constexpr double kUsuallyAtMostMps = 0.3;  // what is more is no wave
    constexpr double kPeak = 1.7;              // of the root of the mean square: two waves in step
    const double dt = trail_.empty() ? 0.0 : now_s - trail_.back().first;
    trail_.push_back({now_s, off});
    while (trail_.size() > 2 && now_s - trail_[1].first >= kCourseS - 1e-6) {
      trail_.pop_front();
    }
    const double span = now_s - trail_.front().first;
    const double speed = steered_mps.norm();
    if (dt > 0.0 && span > 0.5 * kCourseS && speed > kStillMps) {
      const double aside = cross(steered_mps, off - trail_.front().second) / (speed * span);
      const double square = std::pow(std::min(std::abs(aside), kUsuallyAtMostMps), 2);
      felt_s_ = std::min(kMemoryS, felt_s_ + dt);
      square_ += std::min(1.0, dt / felt_s_) * (square - square_);
    }
    return kPeak * std::sqrt(square_);
  }

 private:
  static constexpr double kStillMps = 0.3;
  std::deque<std::pair<double, Eigen::Vector2d>> trail_;
  double felt_s_ = 0.0;
  double square_ = 0.0;
};

}  // namespace otter_nav::encounter
