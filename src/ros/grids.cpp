#include "otter_nav/ros/grids.hpp"

#include <algorithm>
#include <cmath>

#include "otter_nav/ros/frames.hpp"

namespace otter_nav::ros_bridge {
namespace {

constexpr int kOccupied = 100;
constexpr int kOccupiedFrom = 65;
constexpr int kUnknown = -1;
constexpr std::uint32_t kMaxSide = 20000;

std::int8_t toValue(map::Cell cell) {
  switch (cell) {
    case map::Cell::kFree:
      return 0;
    case map::Cell::kOccupied:
      return kOccupied;
    default:
      return kUnknown;
  }
}

map::Cell toCell(std::int8_t value) {
  if (value < 0) {
    return map::Cell::kUnknown;
  }
  return value >= kOccupiedFrom ? map::Cell::kOccupied : map::Cell::kFree;
}

Status checkInfo(const nav_msgs::OccupancyGrid& message, const std::string& frame) {
  const nav_msgs::MapMetaData& info = message.info;
  if (Status status = checkFrame(message.header.frame_id, frame); !status) {
    return status;
  }
  if (info.width == 0 || info.height == 0 || info.width > kMaxSide || info.height > kMaxSide) {
    return failure("size " + std::to_string(info.width) + " by " + std::to_string(info.height) +
                   " is outside its allowed range [1, " + std::to_string(kMaxSide) + "]");
  }
  if (message.data.size() != static_cast<std::size_t>(info.width) * info.height) {
    return failure("data holds " + std::to_string(message.data.size()) + " cells, expected " +
                   std::to_string(info.width) + " times " + std::to_string(info.height));
  }
  if (!std::isfinite(info.resolution) || info.resolution <= 0.0F) {
    return failure("resolution has to be positive");
  }
  if (!std::isfinite(info.origin.position.x) || !std::isfinite(info.origin.position.y)) {
    return failure("origin is not finite");
  }
  if (std::abs(info.origin.orientation.z) > 1e-6) {
    return failure("a rotated map (origin.orientation) is not supported");
  }
  return {};
}

}  // namespace

nav_msgs::OccupancyGrid toMessage(const map::OccupancyGrid& grid, const std::string& frame,
                                  const ros::Time& stamp, const ros::Time& load_time) {
  nav_msgs::OccupancyGrid message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  message.info.map_load_time = load_time;
  message.info.resolution = static_cast<float>(grid.geometry.resolution_m);
  message.info.width = static_cast<std::uint32_t>(grid.geometry.width);
  message.info.height = static_cast<std::uint32_t>(grid.geometry.height);
  message.info.origin.position.x = grid.geometry.origin.x();
  message.info.origin.position.y = grid.geometry.origin.y();
  message.info.origin.orientation.w = 1.0;
  message.data.resize(grid.cells.size());
  std::transform(grid.cells.begin(), grid.cells.end(), message.data.begin(), toValue);
  return message;
}

map_msgs::OccupancyGridUpdate updateMessage(const map::OccupancyGrid& grid,
                                            const map::CellRectangle& window,
                                            const std::string& frame, const ros::Time& stamp) {
  map_msgs::OccupancyGridUpdate update;
  update.header.frame_id = frame;
  update.header.stamp = stamp;
  update.x = window.column;
  update.y = window.row;
  update.width = static_cast<std::uint32_t>(window.width);
  update.height = static_cast<std::uint32_t>(window.height);
  update.data.reserve(static_cast<std::size_t>(window.width) *
                      static_cast<std::size_t>(window.height));
  for (int row = window.row; row < window.row + window.height; ++row) {
    for (int column = window.column; column < window.column + window.width; ++column) {
      update.data.push_back(toValue(grid.at(column, row)));
    }
  }
  return update;
}

Result<map::OccupancyGrid> toGrid(const nav_msgs::OccupancyGrid& message,
                                  const std::string& frame) {
  if (const Status info = checkInfo(message, frame); !info) {
    return failure(info.error().message);
  }
  map::OccupancyGrid grid;
  grid.geometry.width = static_cast<int>(message.info.width);
  grid.geometry.height = static_cast<int>(message.info.height);
  grid.geometry.resolution_m = static_cast<double>(message.info.resolution);
  grid.geometry.origin = {message.info.origin.position.x, message.info.origin.position.y};
  grid.cells.resize(message.data.size());
  std::transform(message.data.begin(), message.data.end(), grid.cells.begin(), toCell);
  return grid;
}

Result<map::CellRectangle> applyUpdate(const map_msgs::OccupancyGridUpdate& update,
                                       const std::string& frame, map::OccupancyGrid& grid) {
  if (const Status status = checkFrame(update.header.frame_id, frame); !status) {
    return failure(status.error().message);
  }
  const auto width = static_cast<std::int64_t>(update.width);
  const auto height = static_cast<std::int64_t>(update.height);
  if (update.x < 0 || update.y < 0 || update.x + width > grid.geometry.width ||
      update.y + height > grid.geometry.height) {
    return failure("the window lies outside the map");
  }
  if (update.data.size() != static_cast<std::size_t>(width * height)) {
    return failure("data holds " + std::to_string(update.data.size()) + " cells, expected " +
                   std::to_string(width * height));
  }
  map::CellRectangle changed;
  std::size_t next = 0;
  for (int row = update.y; row < update.y + height; ++row) {
    for (int column = update.x; column < update.x + width; ++column) {
      map::Cell& cell = grid.cells[grid.geometry.index(column, row)];
      const map::Cell value = toCell(update.data[next++]);
      if (cell != value) {
        cell = value;
        changed.include(column, row);
      }
    }
  }
  return changed;
}

}  // namespace otter_nav::ros_bridge
