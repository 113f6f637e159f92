// The trajectories a planner published, and where each had the vessel be.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <optional>

#include "otter_nav/stopping/splice.hpp"
#include "otter_nav/trajectory/trajectory.hpp"
#include "otter_nav/vessel/parameters.hpp"

namespace otter_nav::nodes {

class ReferenceLog {
 public:
  explicit ReferenceLog(vessel::Parameters vessel) : vessel_(std::move(vessel)) {}

  void add(std::uint32_t id, double start_s, trajectory::Trajectory trajectory) {
    if (entries_.empty() || id > entries_.back().id) {
      entries_.push_back({id, start_s, std::move(trajectory)});
    }
    while (entries_.size() > kSize) {
      entries_.pop_front();
    }
  }
  [[nodiscard]] std::uint32_t latestId() const { return entries_.empty() ? 0 : entries_.back().id; }

  // [x m, y m, psi rad] on the latest trajectory that has begun by then; nothing if there is none
  // or it is an order to stop.
  [[nodiscard]] std::optional<Eigen::Vector3d> pose(double time_s) const {
    const Entry* entry = at(time_s);
    if (entry == nullptr || entry->trajectory.empty()) {
      return std::nullopt;
    }
    return Eigen::Vector3d(
        entry->trajectory.sample(time_s - entry->start_s, vessel_).state.head<3>());
  }
  // Along that trajectory to its end, m.
  [[nodiscard]] std::optional<double> distanceLeft(double time_s) const {
    const Entry* entry = at(time_s);
    if (entry == nullptr || entry->trajectory.empty()) {
      return std::nullopt;
    }
    return trajectory::length(stopping::remainder(entry->trajectory, time_s - entry->start_s));
  }

 private:
  struct Entry {
    std::uint32_t id = 0;
    double start_s = 0.0;
    trajectory::Trajectory trajectory;
  };
  static constexpr std::size_t kSize = 20;

  [[nodiscard]] const Entry* at(double time_s) const {
    for (auto entry = entries_.rbegin(); entry != entries_.rend(); ++entry) {
      if (entry->start_s <= time_s) {
        return &*entry;
      }
    }
    return nullptr;
  }

  vessel::Parameters vessel_;
  std::deque<Entry> entries_;
};

}  // namespace otter_nav::nodes
