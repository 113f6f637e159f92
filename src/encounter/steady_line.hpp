// A straight line through the positions of the last while: a track's own velocity follows each
// scan and wanders more than a course kept does.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

namespace otter_nav::encounter {

class SteadyLine {
 public:
  void restart(double now_s) {
    *this = SteadyLine();
    since_s_ = now_s;
  }
  void add(double now_s, const Eigen::Vector2d& position) {
    constexpr double kMemoryS = 20.0;
    const double step = weight_ > 0.0 ? now_s - last_s_ : 0.0;
    if (weight_ > 0.0 && step <= 0.0) {
      return;
    }
    last_s_ = now_s;
    // Moments about now, older ones counting less.
    time2_ += step * (step * weight_ - 2.0 * time_);
    cross_ -= step * sum_;
    time_ -= step * weight_;
    const double keep = std::exp(-step / kMemoryS);
    weight_ = keep * weight_ + 1.0;
    time_ *= keep;
    time2_ *= keep;
    sum_ = keep * sum_ + position;
    cross_ *= keep;
  }
  [[nodiscard]] double span() const { return last_s_ - since_s_; }
  // Once there is enough of it.
  [[nodiscard]] std::optional<Eigen::Vector2d> velocity() const {
    constexpr double kEnoughS = 5.0;
    const double spread = weight_ * time2_ - time_ * time_;
    if (span() < kEnoughS || spread < 1e-6) {
      return std::nullopt;
    }
    return Eigen::Vector2d((weight_ * cross_ - time_ * sum_) / spread);
  }

 private:
  double since_s_ = 0.0;
  double last_s_ = 0.0;
  double weight_ = 0.0;
  double time_ = 0.0;
  double time2_ = 0.0;
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d cross_ = Eigen::Vector2d::Zero();
};

}  // namespace otter_nav::encounter
