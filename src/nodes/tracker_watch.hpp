// What the planner needs to know of the tracker: which trajectory and near obstacles it has,
// whether it gave up, how far off its way it is, and the force it feels. Which trajectory it has
// counts at once. The rest counts by the statuses' stamps, up to a time the caller names: in
// lockstep no decision may depend on which message was quicker.
#pragma once

#include <otter_nav/TrackerStatus.h>

#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include "otter_nav/ros/conversions.hpp"
#include "stamps.hpp"

namespace otter_nav::nodes {

class TrackerWatch {
 public:
  void take(const TrackerStatus& status) {
    accepted_id_ = status.accepted_id;
    refused_id_ = status.refused_id;
    refused_reason_ = status.refused_reason;
    near_id_ = status.near_obstacles_id;
    const double stamp_s = status.header.stamp.toSec();
    if (stamp_s < latest_s_ - kAheadMostS) {  // the clock was set back
      waiting_.clear();
      latest_s_ = 0.0;
    }
    const bool repeated = stamp_s > 0.0 && stamp_s <= latest_s_;
    if (!repeated) {
      latest_s_ = stamp_s;
      waiting_.push_back(status);
    }
    if (waiting_.size() > kMostWaiting) {  // nobody decides, without a map
      count(waiting_.front());
      waiting_.pop_front();
    }
  }

  // Whether everything stamped `until_s` or before has come, from a tracker that stamps at all.
  [[nodiscard]] bool complete(double until_s) const {
    return latest_s_ <= 0.0 || latest_s_ > until_s;
  }
  // From now on what was stamped `until_s` or before counts.
  void countUntil(double until_s) {
    while (!waiting_.empty() && waiting_.front().header.stamp.toSec() <= until_s) {
      count(waiting_.front());
      waiting_.pop_front();
    }
  }

  // The trajectory to be sailed from now on; `stop` for an order to stop.
  void expect(std::uint32_t id, bool stop) {
    sailing_id_ = stop ? kNone : id;
    faults_ = 0;
  }

  // Whether the tracker has said something about the trajectory.
  [[nodiscard]] bool answered(std::uint32_t id) const {
    return accepted_id_ >= id || refused_id_ >= id;
  }
  // Whether the near obstacles have come to it, if it takes any: a tracker that never told of one
  // is not waited for.
  [[nodiscard]] bool hasNearObstacles(std::uint32_t id) const {
    return near_id_ == 0 || near_id_ >= id;
  }
  // Told several times in a row: one status may cross a new trajectory on its way.
  [[nodiscard]] bool gaveUp() const { return faults_ >= kFaults || refused_id_ == sailing_id_; }
  [[nodiscard]] const std::string& reason() const {
    return refused_id_ == sailing_id_ ? refused_reason_ : reason_;
  }
  // The wind, current and force it estimates; the last that were finite.
  [[nodiscard]] const vessel::DisturbanceEstimate& estimate() const { return estimate_; }
  // How far the vessel is off where the tracker wants it now on what is to be sailed, m: perhaps
  // later on that way, or on a curve to it. Nothing if no status of late tells.
  [[nodiscard]] std::optional<double> trackingError(double now_s) const {
    const bool counts = off_id_ == sailing_id_ && std::abs(now_s - off_stamp_s_) < kOffForS;
    return counts ? off_m_ : std::nullopt;
  }
  // Where it expects the vessel, by the last status that told it.
  [[nodiscard]] const vessel::Foreseen& foreseen() const { return foreseen_; }

 private:
  void count(const TrackerStatus& status) {
    const bool gave_up = status.state == TrackerStatus::FAULT ||
                         status.state == TrackerStatus::STOPPING ||
                         status.state == TrackerStatus::STOPPED;
    faults_ = gave_up && status.trajectory_id == sailing_id_ ? faults_ + 1 : 0;
    reason_ = status.reason;
    const bool follows =
        status.state == TrackerStatus::TRACKING || status.state == TrackerStatus::HOLDING;
    off_m_.reset();
    if (follows && std::isfinite(status.position_error) && status.position_error > 0.0) {
      off_m_ = status.position_error;
    }
    off_id_ = status.trajectory_id;
    off_stamp_s_ = status.header.stamp.toSec();
    if (const auto estimate = ros_bridge::disturbanceEstimate(status.estimate)) {
      estimate_ = *estimate;
    }
    if (auto foreseen = ros_bridge::toForeseen(status.foreseen)) {
      foreseen_ = std::move(*foreseen);
    }
  }

  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr int kFaults = 3;
  static constexpr std::size_t kMostWaiting = 1000;
  static constexpr double kOffForS = 0.5;

  std::uint32_t accepted_id_ = 0;
  std::uint32_t refused_id_ = 0;
  std::uint32_t near_id_ = 0;
  std::uint32_t sailing_id_ = kNone;
  int faults_ = 0;
  std::optional<double> off_m_;  // by the last status that counts
  std::uint32_t off_id_ = 0;
  double off_stamp_s_ = 0.0;
  vessel::DisturbanceEstimate estimate_;
  vessel::Foreseen foreseen_;
  double latest_s_ = 0.0;              // stamp of the last status
  std::deque<TrackerStatus> waiting_;  // to count, in the order they came
  std::string reason_;
  std::string refused_reason_;
};

}  // namespace otter_nav::nodes
