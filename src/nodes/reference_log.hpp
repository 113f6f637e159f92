// The trajectories a planner published, and where each had the vessel be.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>

#include "otter_nav/stopping/splice.hpp"
#include "otter_nav/trajectory/timed_trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::nodes {

class ReferenceLog {
 public:
  explicit ReferenceLog(vessel::Parameters vessel) : vessel_(std::move(vessel)) {}

  void add(std::uint32_t id, trajectory::TimedTrajectory planned) {
    if (entries_.empty() || id > entries_.back().id) {
      entries_.push_back({id, std::move(planned)});
    }
    while (entries_.size() > kSize) {
      entries_.pop_front();
    }
  }

  // [x m, y m, psi rad] on the latest trajectory that has begun by then; nothing if there is none
  // or it is an order to stop.
  [[nodiscard]] std::optional<Eigen::Vector3d> pose(double time_s) const {
    const trajectory::TimedTrajectory* planned = at(time_s);
    if (planned == nullptr) {
      return std::nullopt;
    }
    return Eigen::Vector3d(
        planned->trajectory.sample(planned->elapsed(time_s), vessel_).state.head<3>());
  }
  // Along that trajectory to its end, m.
  [[nodiscard]] std::optional<double> distanceLeft(double time_s) const {
    const trajectory::TimedTrajectory* planned = at(time_s);
    if (planned == nullptr) {
      return std::nullopt;
    }
    return trajectory::length(stopping::remainder(planned->trajectory, planned->elapsed(time_s)));
  }

 private:
  struct Entry {
    std::uint32_t id = 0;
    trajectory::TimedTrajectory planned;
  };
  static constexpr std::size_t kSize = 20;

  [[nodiscard]] const trajectory::TimedTrajectory* at(double time_s) const {
    const auto latest = std::find_if(entries_.rbegin(), entries_.rend(), [&](const Entry& entry) {
      return entry.planned.start_time_s <= time_s;
    });
    return latest == entries_.rend() || latest->planned.trajectory.empty() ? nullptr
                                                                           : &latest->planned;
  }

  vessel::Parameters vessel_;
  std::deque<Entry> entries_;
};

}  // namespace otter_nav::nodes
