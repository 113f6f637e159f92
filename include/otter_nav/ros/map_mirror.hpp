// A node's own copy of the map, with its distance field, kept up to date from `map` and
// `map_updates`.
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>

#include <deque>

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/distance_field.hpp"

namespace otter_nav::ros_bridge {

class MapMirror {
 public:
  explicit MapMirror(const map::DistanceFieldOptions& options) : options_(options) {}

  // A map of another load time or size replaces what is here. The same map sent again is ignored:
  // the updates have it all.
  [[nodiscard]] Status take(const nav_msgs::OccupancyGrid& message);
  // The cells that changed. Updates that come before the map wait for it.
  [[nodiscard]] Result<map::CellRectangle> take(const map_msgs::OccupancyGridUpdate& update);

  [[nodiscard]] bool ready() const { return !grid_.cells.empty(); }
  [[nodiscard]] const map::OccupancyGrid& grid() const { return grid_; }
  [[nodiscard]] const map::DistanceField& field() const { return field_; }
  // In which the unknown is occupied.
  [[nodiscard]] const map::DistanceField& knownWater() const { return known_; }
  // Of the last update, zero before.
  [[nodiscard]] const ros::Time& stamp() const { return stamp_; }

 private:
  map::DistanceFieldOptions options_;
  map::OccupancyGrid grid_;
  map::DistanceField field_;
  map::DistanceField known_;
  ros::Time load_time_;
  ros::Time stamp_;
  std::deque<map_msgs::OccupancyGridUpdate> waiting_;  // for the map
};

}  // namespace otter_nav::ros_bridge
