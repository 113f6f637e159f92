// Occupancy grids and their updates between messages and the core.
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::ros_bridge {

// Free is 0, occupied 100, unknown -1. The load time tells one map from the next.
[[nodiscard]] nav_msgs::OccupancyGrid toMessage(const map::OccupancyGrid& grid,
                                                const std::string& frame, const ros::Time& stamp,
                                                const ros::Time& load_time);
[[nodiscard]] map_msgs::OccupancyGridUpdate updateMessage(const map::OccupancyGrid& grid,
                                                          const map::CellRectangle& window,
                                                          const std::string& frame,
                                                          const ros::Time& stamp);

// Cells of 65 and more are occupied, below that free. An error names the field: frame, size,
// resolution, rotation.
[[nodiscard]] Result<map::OccupancyGrid> toGrid(const nav_msgs::OccupancyGrid& message,
                                                const std::string& frame);

// Writes the update into `grid` and returns the window of cells it really changed. A refused
// update leaves the grid as it was.
[[nodiscard]] Result<map::CellRectangle> applyUpdate(const map_msgs::OccupancyGridUpdate& update,
                                                     const std::string& frame,
                                                     map::OccupancyGrid& grid);

}  // namespace otter_nav::ros_bridge
