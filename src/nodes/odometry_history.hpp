// The last few seconds of odometry.
#pragma once

#include <deque>
#include <optional>

#include "otter_nav/ros/conversions.hpp"
#include "stamps.hpp"

namespace otter_nav::nodes {

class OdometryHistory {
 public:
  // False, and nothing changes, if the stamp goes backwards.
  bool add(const ros_bridge::OdometrySample& sample) {
    if (!samples_.empty() && sample.stamp_s < samples_.back().stamp_s) {
      return false;
    }
    samples_.push_back(sample);
    while (samples_.size() > kSize) {
      samples_.pop_front();
    }
    return true;
  }

  // The clock was set back: what was stamped before is void.
  void forgetWhatIsAhead(const ros::Time& now) {
    if (!samples_.empty() && isAhead(ros_bridge::toRosTime(samples_.back().stamp_s), now)) {
      samples_.clear();
    }
  }

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  [[nodiscard]] const ros_bridge::OdometrySample& latest() const { return samples_.back(); }

  // The first sample that is not older than `stamp_s`; nothing if it has not come yet.
  [[nodiscard]] std::optional<ros_bridge::OdometrySample> at(double stamp_s) const {
    if (samples_.empty() || samples_.back().stamp_s < stamp_s) {
      return std::nullopt;
    }
    auto found = samples_.end();
    while (found != samples_.begin() && std::prev(found)->stamp_s >= stamp_s) {
      --found;
    }
    return *found;
  }

 private:
  static constexpr std::size_t kSize = 500;
  std::deque<ros_bridge::OdometrySample> samples_;
};

}  // namespace otter_nav::nodes
