// Occupancy grids and their updates between messages and the core.
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <nav_msgs/OccupancyGrid.h>

#include <string>

#include "otter_nav/base/result.hpp"
#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::ros_bridge {

// A window of cells: columns [column, column + width), rows alike.
struct Window {
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;
  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
};

// Free is 0, occupied 100, unknown -1.
[[nodiscard]] nav_msgs::OccupancyGrid toMessage(const map::OccupancyGrid& grid,
                                                const std::string& frame, const ros::Time& stamp);
[[nodiscard]] map_msgs::OccupancyGridUpdate updateMessage(const map::OccupancyGrid& grid,
                                                          const Window& window,
                                                          const std::string& frame,
                                                          const ros::Time& stamp);

// Cells of 65 and more are occupied, below that free. An error names the field: frame, size,
// resolution, rotation.
[[nodiscard]] Result<map::OccupancyGrid> toGrid(const nav_msgs::OccupancyGrid& message,
                                                const std::string& frame);

// Writes the update into `grid` and returns the window of cells it really changed. A refused
// update leaves the grid as it was.
[[nodiscard]] Result<Window> applyUpdate(const map_msgs::OccupancyGridUpdate& update,
                                         const std::string& frame, map::OccupancyGrid& grid);

}  // namespace otter_nav::ros_bridge
