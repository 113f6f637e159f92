// What is known of the water as a picture, without rviz.
#pragma once

#include <map_msgs/OccupancyGridUpdate.h>
#include <sensor_msgs/LaserScan.h>

#include <QImage>
#include <QPolygonF>
#include <optional>
#include <string>
#include <vector>

#include "otter_nav/map/occupancy_grid.hpp"

namespace otter_nav::rviz_plugins {

// The picture of the chart: a pixel a cell, row 0 in the south.
class ChartPicture {
 public:
  void setChart(map::OccupancyGrid chart);
  void setMap(map::OccupancyGrid map);
  // What changed, as after the next two.
  QRect update(const map_msgs::OccupancyGridUpdate& update, std::string& error);
  // Water that beams have crossed: a fan in the map frame, m.
  QRect see(const QPolygonF& fan);
  void forgetSeen();

  [[nodiscard]] bool empty() const { return map_.cells.empty(); }
  [[nodiscard]] const map::GridGeometry& geometry() const { return map_.geometry; }
  [[nodiscard]] const QImage& image() const { return image_; }

 private:
  void alignChart();
  void paint(QRect part);
  [[nodiscard]] std::size_t index(int column, int row) const {
    return map_.geometry.index(column, row);
  }

  std::optional<map::OccupancyGrid> chart_;
  map::OccupancyGrid map_;
  bool map_is_chart_ = false;       // until a map comes
  std::vector<map::Cell> charted_;  // the chart's cells on the map's grid
  std::vector<bool> ashore_;        // so near to charted land that an echo there is the coast's
  QImage seen_;                     // not 0 where a beam went
  QImage image_;
};

// Of a scan taken at the origin with x ahead: where its beams went, m.
[[nodiscard]] QPolygonF fanOf(const sensor_msgs::LaserScan& message);

}  // namespace otter_nav::rviz_plugins
