#include "chart_picture.hpp"

#include <QPainter>
#include <QTransform>
#include <algorithm>

#include "nautical_palette.hpp"
#include "otter_nav/map/chart.hpp"
#include "otter_nav/ros/frames.hpp"
#include "otter_nav/ros/grids.hpp"
#include "otter_nav/ros/scans.hpp"

namespace otter_nav::rviz_plugins {
namespace {

constexpr QRgb kCoastline = 0xff7d6a3cU;

}  // namespace

QPolygonF fanOf(const sensor_msgs::LaserScan& message) {
  const Scan scan = ros_bridge::toScan(message);
  QPolygonF fan;
  fan << QPointF(0.0, 0.0);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double far = scan.metNothing(i)     ? scan.range_max_m
                       : scan.metSomething(i) ? static_cast<double>(scan.ranges_m[i])
                                              : 0.0;
    const Eigen::Vector3d end = far * scan.direction(i);
    fan << QPointF(end.x(), end.y());
  }
  return fan;
}

void ChartPicture::setChart(map::OccupancyGrid chart) {
  chart_ = std::move(chart);
  if (empty() || map_is_chart_) {
    setMap(*chart_);
    map_is_chart_ = true;
  } else {
    alignChart();
    paint(image_.rect());
  }
}

void ChartPicture::setMap(map::OccupancyGrid map) {
  const bool same = !empty() && map.geometry == map_.geometry;
  map_ = std::move(map);
  map_is_chart_ = false;
  if (!same) {
    seen_ = QImage(map_.geometry.width, map_.geometry.height, QImage::Format_Grayscale8);
    seen_.fill(0);
    image_ = QImage(map_.geometry.width, map_.geometry.height, QImage::Format_ARGB32);
  }
  alignChart();
  paint(image_.rect());
}

void ChartPicture::alignChart() {
  charted_.assign(map_.cells.size(), map::Cell::kUnknown);
  for (int row = 0; chart_ && row < map_.geometry.height; ++row) {
    for (int column = 0; column < map_.geometry.width; ++column) {
      const Eigen::Vector2d centre = map_.geometry.centreOf(column, row);
      if (chart_->geometry.contains(centre)) {
        const Eigen::Vector2i cell = chart_->geometry.cellAt(centre);
        charted_[index(column, row)] = chart_->at(cell.x(), cell.y());
      }
    }
  }
  ashore_ = map::coastOf({map_.geometry, charted_});
}

QRect ChartPicture::update(const map_msgs::OccupancyGridUpdate& update, std::string& error) {
  if (empty()) {
    return {};
  }
  const auto changed = ros_bridge::applyUpdate(update, ros_bridge::frames().map, map_);
  if (!changed) {
    error = changed.error().message;
    return {};
  }
  // A coast is drawn on its neighbours' account.
  const QRect part =
      QRect(changed->column - 1, changed->row - 1, changed->width + 2, changed->height + 2) &
      image_.rect();
  paint(part);
  return part;
}

QRect ChartPicture::see(const QPolygonF& fan) {
  if (empty()) {
    return {};
  }
  const map::GridGeometry& g = map_.geometry;
  QTransform to_cells;
  to_cells.scale(1.0 / g.resolution_m, 1.0 / g.resolution_m);
  to_cells.translate(-g.origin.x(), -g.origin.y());
  const QPolygonF cells = to_cells.map(fan);
  QPainter painter(&seen_);
  painter.setPen(Qt::NoPen);
  painter.setBrush(Qt::white);
  painter.drawPolygon(cells);
  painter.end();
  const QRect part = cells.boundingRect().toAlignedRect().adjusted(-1, -1, 1, 1) & image_.rect();
  paint(part);
  return part;
}

void ChartPicture::forgetSeen() {
  if (!empty()) {
    seen_.fill(0);
    paint(image_.rect());
  }
}

void ChartPicture::paint(QRect part) {
  const map::GridGeometry& g = map_.geometry;
  const auto isLand = [&](int column, int row) {
    if (!g.containsCell(column, row)) {
      return true;
    }
    const std::size_t i = index(column, row);
    return map_.cells[i] == map::Cell::kOccupied && charted_[i] == map::Cell::kOccupied;
  };
  for (int row = part.top(); row <= part.bottom(); ++row) {
    auto* pixels = reinterpret_cast<QRgb*>(image_.scanLine(row));
    const uchar* seen = seen_.constScanLine(row);
    for (int column = part.left(); column <= part.right(); ++column) {
      const std::size_t i = index(column, row);
      const Water water = waterOf(charted_[i], map_.cells[i], seen[column] != 0);
      const bool coast =
          water == Water::kLand && !(isLand(column - 1, row) && isLand(column + 1, row) &&
                                     isLand(column, row - 1) && isLand(column, row + 1));
      pixels[column] =
          coast || (water == Water::kSensed && ashore_[i]) ? kCoastline : colourOf(water);
    }
  }
}

}  // namespace otter_nav::rviz_plugins
