#include "otter_nav/ros/map_mirror.hpp"

#include <algorithm>
#include <utility>

#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/grids.hpp"

namespace otter_nav::ros_bridge {
namespace {

constexpr std::size_t kMostWaiting = 1000;

}  // namespace

Status MapMirror::take(const nav_msgs::OccupancyGrid& message) {
  Result<map::OccupancyGrid> grid = toGrid(message, frames().map);
  if (!grid) {
    return failure(grid.error().message);
  }
  const bool same =
      ready() && message.info.map_load_time == load_time_ && grid->geometry == grid_.geometry;
  if (!same) {
    grid_ = std::move(*grid);
    field_ = map::DistanceField(grid_, options_);
    known_ = map::DistanceField(grid_, {map::kKnownWaterDistanceM, true});
    load_time_ = message.info.map_load_time;
  }
  Status status;
  for (; !waiting_.empty(); waiting_.pop_front()) {
    if (const auto changed = take(waiting_.front()); !changed && status) {
      status = failure("an update before it: " + changed.error().message);
    }
  }
  return status;
}

Result<map::CellRectangle> MapMirror::take(const map_msgs::OccupancyGridUpdate& update) {
  if (!ready()) {
    if (waiting_.size() >= kMostWaiting) {
      return failure("there is no map yet");
    }
    waiting_.push_back(update);
    return map::CellRectangle{};
  }
  Result<map::CellRectangle> changed = applyUpdate(update, frames().map, grid_);
  if (changed) {
    stamp_ = std::max(stamp_, update.header.stamp);
    field_.update(grid_, *changed);
    known_.update(grid_, *changed);
  }
  return changed;
}

}  // namespace otter_nav::ros_bridge
